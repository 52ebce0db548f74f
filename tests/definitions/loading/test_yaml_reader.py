"""The YAML reader takes anything and hands back plain data with places, or says what is wrong."""

from __future__ import annotations

import math
from typing import Any

import pytest
import yaml
from hypothesis import example, given
from hypothesis import strategies as st

from certkit.definitions.loading import yaml_reader as reader
from certkit.definitions.loading.yaml_reader import read_tree, read_value
from certkit.errors import DefinitionError
from certkit.files.limits import MAX_DEFINITION_BYTES, MAX_DEFINITION_DEPTH


def read(text: str | bytes) -> dict[str, Any]:
    return read_tree(text, "test.yaml").data


def problems(text: str | bytes) -> list[str]:
    try:
        found = read_tree(text, "test.yaml").problems
    except DefinitionError as error:
        found = error.problems
    return [str(problem) for problem in found]


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("no", "no"),
        ("yes", "yes"),
        ("on", "on"),
        ("off", "off"),
        ("12:30", "12:30"),
        ("2026-01-31", "2026-01-31"),
        ("1_000", "1_000"),
        ("0x1F", "0x1F"),
        ("010", 10),
        ("1e-3", 1e-3),
        ("1.5", 1.5),
        ("-.5", -0.5),
        ("+3", 3),
        ("true", True),
        ("False", False),
        ("~", None),
        ("", None),
        ("null", None),
        ("'12'", "12"),
        ('"true"', "true"),
        (".inf", math.inf),
        ("-.INF", -math.inf),
    ],
)
def test_a_plain_scalar_means_what_yaml_1_2_says(written: str, meant: object):
    value = read(f"key: {written}")["key"]
    assert value == meant
    assert isinstance(value, bool) == isinstance(meant, bool)
    assert isinstance(value, str) == isinstance(meant, str)


def test_not_a_number_is_read_as_such():
    assert math.isnan(read("key: .nan")["key"])


def test_a_number_remembers_how_it_was_written():
    data = read("{serial: 010, clause: 1.20}")
    assert (str(data["serial"]), str(data["clause"])) == ("010", "1.20")


def test_keys_are_words_whatever_they_look_like():
    assert read("{1: a, no: b, null: c}") == {"1": "a", "no": "b", "null": "c"}


def test_every_value_and_key_has_its_place():
    tree = read_tree("a:\n  b: [1,\n    2]\nc: {d: 3}\n", "test.yaml")
    assert tree.values[("a", "b", 1)] == (3, 5)
    assert tree.values[("c", "d")] == (4, 8)
    assert tree.keys[("c", "d")] == (4, 5)


def test_a_path_that_is_not_in_the_file_has_its_nearest_ancestors_place():
    tree = read_tree("a:\n  b: 1\n", "test.yaml")
    assert tree.place(("a", "missing", "deeper")) == tree.values[("a",)]


def test_duplicate_keys_are_all_reported_with_both_lines():
    assert problems("a: 1\nb: {c: 1, c: 2}\na: 2\n") == [
        "test.yaml:2:11: `c` stands here twice (first in line 2); keep one",
        "test.yaml:3:1: `a` stands here twice (first in line 1); keep one",
    ]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "a: !!python/object/apply:os.system ['true']",
            "1:4: the tag `tag:yaml.org,2002:python/object/apply",
        ),
        ("a: !!int 3", "the tag `tag:yaml.org,2002:int` is not used here"),
        ("a:\n\tb: 1", "2:1: a tab cannot indent YAML; use spaces"),
        ("a: b: c", "1:5: a second `:` in one line"),
        ("a: [1, 2", "is not YAML"),
        ("a: 'x", "is not YAML"),
        ("a: @b", "1:4: a value cannot start like this; put it in quotes"),
        ("a: *unknown", "`*unknown` names no value before it"),
        ("a: &self [*self]", "`*self` names no value before it"),
        ("", "1:1: is empty"),
        ("# only a comment", "is empty"),
        ("- 1\n- 2", "1:1: is not a mapping"),
        ("word", "1:1: is not a mapping"),
        ("a: 1\n---\nb: 2", "2:1: a second document starts here"),
        ("? [a, b]\n: 1", "a key has to be a word"),
        ("a: \x00", "a character that YAML does not allow"),
        (b"a: 1\nb: \xff", "2:4: byte 0xff is not UTF-8"),
        ("a: 1".encode("utf-16"), "saved as UTF-16"),
        (b"x" * (MAX_DEFINITION_BYTES + 1), "larger than 2 MB"),
    ],
)
def test_what_cannot_be_read_is_said_with_its_place(text: str | bytes, said: str):
    (problem,) = problems(text)
    assert problem.startswith("test.yaml")
    assert said in problem


def test_a_byte_order_mark_does_no_harm():
    assert read(b"\xef\xbb\xbfa: 1") == {"a": 1}


def test_aliases_are_copies():
    data = read("a: &x {b: [1]}\nc: *x\n")
    assert data["c"] == data["a"]
    assert data["c"]["b"] is not data["a"]["b"]


def test_aliases_cannot_explode():
    lines = ["a0: &a0 [1, 2, 3, 4, 5, 6, 7, 8, 9]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, 12)]
    (problem,) = problems("\n".join(lines))
    assert "counting aliases with all they stand for" in problem


def test_aliases_cannot_nest_without_limit():
    lines = ["a0: &a0 [1]", *(f"a{i}: &a{i} [*a{i - 1}]" for i in range(1, 500))]
    (problem,) = problems("\n".join(lines))
    assert f"nested more than {MAX_DEFINITION_DEPTH} levels deep" in problem


@pytest.mark.parametrize("opening", ["[", "{a: ", "- "])
def test_depth_is_limited(opening: str):
    (problem,) = problems("top: \n  " + opening * 100_000 if opening == "- " else "top: " + opening * 100_000)
    assert f"nested more than {MAX_DEFINITION_DEPTH} levels deep" in problem or "is not YAML" in problem


def test_the_parser_without_libyaml_says_the_same(monkeypatch: pytest.MonkeyPatch):
    text = "a: &x {b: [1, no, 1e-3]}\nc: *x\nd: 1\nd: 2\n"
    fast = read_tree(text, "test.yaml")
    monkeypatch.setattr(reader, "_LOADER", yaml.SafeLoader)
    assert read_tree(text, "test.yaml") == fast


def test_a_value_of_the_command_line_is_read_like_one_in_a_file():
    assert read_value("30 mm", "--set x") == "30 mm"
    assert read_value("{at: femur end, offset: 0 mm}", "--set x") == {"at": "femur end", "offset": "0 mm"}
    assert read_value("", "--set x") is None
    with pytest.raises(DefinitionError, match="--set x"):
        read_value("1\nother: 2", "--set x")


ALPHABET = st.sampled_from("ab: \n\t-[]{},&*!|>'\"#%@`?~0123.e+\\\u00e9\ufeff\x00\x85\u2028\ud800")


@given(st.one_of(st.text(ALPHABET, max_size=60), st.text(max_size=40), st.binary(max_size=60)))
@example("a: &a\n  - *a")
@example("%YAML 9.9\n---\na: 1")
@example("a: |\n\tb")
@example("---\n---\n")
@example("\ud800")
def test_whatever_is_read_there_is_data_or_a_definition_error(text: str | bytes):
    try:
        tree = read_tree(text, "test.yaml")
    except DefinitionError as error:
        said = str(error)
    else:
        assert isinstance(tree.data, dict)
        assert all(line >= 1 and column >= 1 for line, column in tree.values.values())
        said = "test.yaml"
    assert said.startswith("test.yaml")
