"""The legform document: parts, knee, flesh and channels of one legform, each number with its origin."""

from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Section
from certkit.definitions.channels import ChannelKind, ChannelTable
from certkit.definitions.fixture_list import RIG_CHANNELS
from certkit.definitions.legform_channel import Evaluation, LegformChannel
from certkit.definitions.legform_parts import Bone, Flesh, Knee
from certkit.definitions.loading.error_messages import suggestion
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.units import parse_quantity
from certkit.errors import RunError

if TYPE_CHECKING:
    from collections.abc import Iterator

WHOLE = "leg"
"""The specimen that is the whole chain of parts."""
KNEE = "knee"


class Legform(Section):
    """One legform, the same for all procedures: a chain of parts with a knee, its flesh and its channels."""

    legform: Annotated[str, Field(description="Its name.")]
    title: str
    impactor: Annotated[str, Field(min_length=1, description="The impactor that corridors are made for.")]
    fine_location: Annotated[
        str, Field(pattern=r"^[A-Z0-9]{2}$", description="Fine location 3 of its ISO-MME codes.")
    ]
    what_if: Annotated[
        bool, Field(description="The model is a guess, for what-if runs only; each of its results says so.")
    ] = False
    parts: Annotated[
        dict[str, Bone], Field(min_length=2, max_length=50, description="From the top to the bottom.")
    ]
    knee: Knee
    flesh: Flesh
    channels: Annotated[dict[str, LegformChannel], Field(min_length=1, max_length=300)]
    evaluation: Evaluation

    @property
    def chain(self) -> tuple[str, ...]:
        """Return the parts from top to bottom, the knee among them."""
        upper, _ = self.knee.between
        names = list(self.parts)
        at = names.index(upper) + 1
        return (*names[:at], KNEE, *names[at:])

    @property
    def ends(self) -> tuple[str, str]:
        """Return what the upper and the lower end are called: `femur end`, `tibia end`."""
        return f"{self.chain[0]} end", f"{self.chain[-1]} end"

    def whole_mass(self, *, flesh: bool) -> float:
        """Return the mass of all parts and the knee, kg, with the flesh where it is fitted."""
        bare = float(self.knee.mass) + sum(float(part.mass) for part in self.parts.values())
        return bare + (float(self.flesh.mass) if flesh else 0.0)

    def is_upper(self, end: str) -> bool:
        """Tell whether an end is the upper one.

        Raises
        ------
        RunError
            When the leg has no such end.
        """
        if end not in self.ends:
            raise RunError(
                f"the leg has no `{end}`; it has `{self.ends[0]}` and `{self.ends[1]}`; name one of these"
            )
        return end == self.ends[0]

    def gauge_height(self, channel: LegformChannel) -> float:
        """Return the height of a bending moment's gauge above the knee centre, m."""
        chain = self.chain
        up = chain.index(channel.part or "") < chain.index(KNEE)
        return float(channel.from_knee_centre or 0.0) * (1.0 if up else -1.0)

    def span(self, part: str) -> tuple[float, float]:
        """Return top and bottom of a part above the knee centre, m."""
        chain = self.chain
        at, knee = chain.index(part), chain.index(KNEE)
        if at < knee:
            bottom = sum(
                (float(self.parts[p].length) for p in chain[at + 1 : knee]), float(self.knee.above_centre)
            )
            return bottom + float(self.parts[part].length), bottom
        top = -sum((float(self.parts[p].length) for p in chain[knee + 1 : at]), float(self.knee.below_centre))
        return top, top - float(self.parts[part].length)

    @cached_property
    def channel_table(self) -> ChannelTable:
        """Return the channels that a test of this legform can have, those of the rig included."""
        known = self.evaluation
        classes = {
            name: parse_quantity(level, self.channels[name].kind.quantity)
            for level, names in known.amplitude_classes.items()
            for name in names
        }
        usual = {
            name: parse_quantity(text, self.channels[name].kind.quantity)
            for name, text in known.usual_peaks.items()
        }
        signs = {**dict.fromkeys(known.positive, 1), **dict.fromkeys(known.negative, -1)}
        kinds = {
            name: ChannelKind(
                name,
                channel.title,
                channel.kind,
                tuple(channel.codes),
                classes.get(name),
                signs.get(name, 0),
                channel.part or "",
                usual.get(name),
            )
            for name, channel in self.channels.items()
        }
        return ChannelTable(
            legform=self.legform,
            impactor=self.impactor,
            fine_location=self.fine_location,
            kinds=kinds | {kind.name: kind for kind in RIG_CHANNELS},
            bone=tuple(known.bone_channels),
            flight=tuple(known.flight_channels or known.bone_channels),
            contact=tuple(known.contact_channels),
        )

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        faults = [*self._chain_faults()]
        if not faults:
            for name, channel in self.channels.items():
                faults += [
                    (("channels", name, *steps), said) for steps, said in self._channel_faults(channel)
                ]
            faults += self._evaluation_faults()
        titles = [channel.title for channel in self.channels.values()]
        rig = {kind.name for kind in RIG_CHANNELS} | {kind.title for kind in RIG_CHANNELS}
        for name, channel in self.channels.items():
            if {name, channel.title} & rig:
                faults.append((("channels", name), f"`{name}` is a channel of the rig; give it another name"))
            elif titles.count(channel.title) > 1:
                faults.append(
                    (
                        ("channels", name, "title"),
                        f"`{channel.title}` is said of two channels; give each its own title",
                    )
                )
        if faults:
            raise Faults(faults)
        return self

    def _chain_faults(self) -> "Iterator[Fault]":
        names = list(self.parts)
        for name in names:
            if name in {WHOLE, KNEE}:
                yield ("parts", name), f"no part can be called `{name}`; the {name} is described elsewhere"
        for index, end in enumerate(self.knee.between):
            if end not in self.parts:
                yield ("knee", "between", index), f"there is no part `{end}`; {suggestion(end, names)}"
        upper, lower = self.knee.between
        if upper in names and lower in names and names.index(lower) != names.index(upper) + 1:
            message = (
                f"`{upper}` and `{lower}` do not follow on each other in `parts`, which go from the top down"
            )
            yield ("knee", "between"), message
        for name in (names[-1], upper):
            if name in self.parts and self.parts[name].joint is not None:
                below = "nothing" if name == names[-1] else "the knee"
                yield ("parts", name, "joint"), f"{below} is below `{name}`; leave the joint out"

    def _channel_faults(self, channel: LegformChannel) -> "Iterator[Fault]":
        """Yield what is wrong with the place that a channel names."""
        ligaments = self.knee.ligaments
        if channel.ligament is not None and channel.ligament not in ligaments:
            hint = suggestion(channel.ligament, ligaments)
            yield ("ligament",), f"there is no ligament `{channel.ligament}`; {hint}"
        if channel.part is None:
            return
        if channel.part not in self.parts:
            yield ("part",), f"there is no part `{channel.part}`; {suggestion(channel.part, self.parts)}"
            return
        top, bottom = self.span(channel.part)
        if not bottom - 1e-9 <= self.gauge_height(channel) <= top + 1e-9:
            near, far = sorted((abs(top) * 1e3, abs(bottom) * 1e3))
            said = f"is not on the {channel.part}, which reaches from {near:.6g} to {far:.6g} mm"
            yield ("from knee centre",), said

    def _evaluation_faults(self) -> "Iterator[Fault]":
        known = self.evaluation
        rig = [kind.name for kind in RIG_CHANNELS]
        lists: list[tuple[tuple[str, ...], list[str]]] = [
            ((key,), names)
            for key, names in (
                ("bone channels", known.bone_channels),
                ("contact channels", known.contact_channels),
                ("positive", known.positive),
                ("negative", known.negative),
            )
        ]
        lists += [(("amplitude classes", level), names) for level, names in known.amplitude_classes.items()]
        for steps, names in lists:
            allowed = [*self.channels, *(rig if steps == ("contact channels",) else ())]
            for index, name in enumerate(names):
                if name not in allowed:
                    message = f"no channel is called `{name}`; {suggestion(name, allowed)}"
                    yield ("evaluation", *steps, index), message
        for name, text in known.usual_peaks.items():
            if name not in self.channels:
                message = f"no channel is called `{name}`; {suggestion(name, self.channels)}"
                yield ("evaluation", "usual peaks", name), message
                continue
            try:
                parse_quantity(text, self.channels[name].kind.quantity)
            except (ValueError, KeyError) as error:
                yield ("evaluation", "usual peaks", name), str(error)
        for level, names in known.amplitude_classes.items():
            for name in (name for name in names if name in self.channels):
                try:
                    parse_quantity(level, self.channels[name].kind.quantity)
                except (ValueError, KeyError) as error:
                    yield ("evaluation", "amplitude classes", level), f"{error}, which is what `{name}` is"
                    break
