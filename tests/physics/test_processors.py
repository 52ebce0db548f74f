"""A certificate has one id on every processor, though the last bits of a sine are not the same on all."""

from __future__ import annotations

import os
import platform
import subprocess
import sys

import numpy as np
import pytest

from certkit.documents.rounding import rounded_all, rounded_difference, rounded_residual, rounded_series

RUN = "import certkit, sys; print(*(certkit.run(n, refine=n != 'vehicle').id for n in sys.argv[1:]))"

PROCEDURES = ("static-femur", "static-knee", "pendulum", "inverse", "vehicle")

MASKED = ["AVX512F", "AVX512VL", "AVX2", "FMA", "FMA4", "AVX"]

PROCESSORS = {
    "no fused multiply-add": {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=" + ",".join(f"-{f}" for f in MASKED)},
    "no wide vectors in numpy": {"NPY_DISABLE_CPU_FEATURES": "AVX512F AVX512_SKX AVX2 FMA3"},
    "compiled for any processor": {"NUMBA_CPU_NAME": "generic"},
}


def ids(**environment: str) -> list[str]:
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", RUN, *PROCEDURES],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.split()


@pytest.mark.slow
@pytest.mark.skipif(
    platform.libc_ver()[0] != "glibc", reason="only glibc can be told to leave out instructions"
)
def test_the_id_is_the_same_with_instructions_masked():
    usual = ids()
    assert len(usual) == len(PROCEDURES)
    assert {name: ids(**masked) for name, masked in PROCESSORS.items()} == dict.fromkeys(PROCESSORS, usual)


def test_a_sample_near_zero_is_written_with_the_digits_of_its_channel():
    values = np.array([0.0, 3.3e-14, 1.2345678e-5, 123.456789, -250.0])
    written = rounded_series(values)
    assert written == [0.0, 0.0, 1.23e-5, 123.4568, -250.0]
    assert rounded_series(values + 1e-14) == written
    assert rounded_all(values)[1] == 3.3e-14


def test_rounding_again_changes_nothing():
    values = np.random.default_rng(1).normal(size=2000) * np.logspace(-12, 2, 2000)
    once = rounded_series(values)
    assert rounded_series(once) == once
    assert rounded_all(once) == once


def test_a_small_difference_keeps_no_last_bits_of_what_it_is_the_difference_of():
    assert rounded_difference(1.234567891e-5, of=379.77) == 1.2e-5
    assert rounded_difference(3e-13, of=379.77) == 0.0
    assert rounded_difference(0.1234567, of=250.0) == 0.123457


def test_a_residual_keeps_no_last_bits():
    assert rounded_residual(3.1e-13) == 0.0
    assert rounded_residual(0.1234567) == 0.123457
