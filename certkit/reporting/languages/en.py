"""English. Fixed words stand in the templates themselves, so only reasons are told here."""

from __future__ import annotations

from types import MappingProxyType

NAME = "English"

VERDICTS = MappingProxyType(
    {word: word for word in ("pass", "fail", "conditional", "not evaluated", "error", "informative")}
)

WORDS: MappingProxyType[str, str] = MappingProxyType({})

REASONS = MappingProxyType(
    {
        # What a verdict rests on and does not cover.
        "run-untrusted": "The run cannot be trusted: {check} {value:.3g} {unit} exceeds {limit:g} {unit}.",
        "run-untrusted-remedy": (
            "The run cannot be trusted: {check} {value:.3g} {unit} exceeds {limit:g} {unit} ({remedy})."
        ),
        "take-a-smaller-step": "take a smaller step: --set 'run.time step={step:g} s'",
        "stiffen-the-contacts": "stiffen the contacts that overlap",
        "stiffen-the-wall": "the bone behind the flesh is too soft for this load: raise `flesh.wall`",
        "criterion-changes-most": (
            "{criterion} changes most; halve the step: --set 'run.time step={step:g} s'"
        ),
        "test-not-evaluated": "Not evaluated: {reason}.",
        "no-criterion-graded": (
            "Not evaluated: no criterion has a corridor that it could be graded against."
        ),
        "remark-on-criterion": "{criterion}: {reason}.",
        "rests-on-recalled": (
            "Rests on recalled corridors, not verified against the regulation's text ({criteria:and})."
        ),
        "rests-on-secondary": (
            "Rests on secondary corridors, read in somebody's account of the regulation ({criteria:and})."
        ),
        "rests-on-derived": (
            "Rests on derived corridors, which follow by arithmetic from their sources ({criteria:and})."
        ),
        "rests-on-calibrated": "Rests on calibrated limits, which were fitted ({criteria:and}).",
        "rests-on-estimated": "Rests on estimated corridors, which are a judgement ({criteria:and}).",
        "not-covered": "Does not cover {criteria:and}: shown for information, no corridor is known.",
        "compared": "Compared with {reference}: rms error {error:.1f} %.",
        "compared-with-published": (
            "Compared with {reference}: rms error {error:.1f} % "
            "(the published simulation: {published:.1f} %)."
        ),
        "numbers-that-went-in": (
            "Of the {count} numbers that went in, {shares:and}; each is listed with its origin."
        ),
        "count-of-confidence": "{count} {confidence:word}",
        "model-not-legform": (
            "A virtual certification of the model; not a calibration certificate of a legform."
        ),
        "model-for-what-if": (
            "A guessed model, for what-if only: it says nothing about a test with the real legform."
        ),
        "no-calibration-certificate": (
            "An evaluation of a measured test; not a calibration certificate of the legform."
        ),
        # Of a finite-element run.
        # Why a curve follows another badly, and what a rule asks of a comparison.
        "curve-late": "comes {by:.1f} ms late",
        "curve-early": "comes {by:.1f} ms early",
        "curve-size": "its peak is {peak:+.0f} %, its area {area:+.0f} %",
        "curve-slope": "is {times:.2f} times as steep",
        "curve-away": "is more than half the peak away for {share:.0f} % of the time",
        "agreement-rating": "ISO/TS 18571 rating of {channel}",
        "agreement-mean-rating": "Mean ISO/TS 18571 rating",
        "agreement-peak": "Peak of {channel}, difference",
        "agreement-criterion": "d_AC of {channel}",
        "channel-not-shared": "{channel} was not recorded in both",
        "mean-of-some": "only {rated} of {asked} channels are rated",
        "peak-not-compared": "{channel} has no peak that could be compared",
        "no-peak-compared": "no peak could be compared",
        "no-criterion-with-limit": "no criterion with a limit was graded in both; compare two results of `certkit grade`",
        "run-resampled": "Brought to even steps of {interval:.4g} ms by linear interpolation.",
        "run-without-contact": "No contact force was read: time zero is the run's own.",
        "run-does-not-tell": (
            "{quantity} is not known: the run does not tell it, and the mapping's `conditions` neither"
        ),
        "run-outside": "{quantity} is {value:.4g} {unit}, outside {limits}",
        "run-limits-rest-on": "Limits of {quantities:and} are {confidence:word}.",
        "model-not-certified": "the mapping names no certification of the legform model {model}",
        "model-certified": "{model}: {certification}",
        "score-set-not-found": "Scores are not given: the set `{set}` was not found.",
        "score-set-for-other": "Scores are not given: `{set}` is for the {impactor}.",
        "score-not-measured": "Score {score} is not given: {criteria:list} not measured.",
        "spread-over-family": (
            "Values are the nominal leg's, with their spread over {legs} certified legs ({verdicts:list})."
        ),
        "count-of-verdict": "{count} {verdict:verdict}",
        "legs-that-pass": "{criterion}: {passed} of {legs} legs pass.",
        "legs-dropped": "{count} legs of the family could not be run to be trusted and are left out: {legs:list}.",
        "legs-that-fail": "{count} legs of the family fail, and stay in the spread: {legs:list}.",
        "leg-number": "number {number}",
        "leg-that-misses": "number {number} ({checks:list})",
        "not-determined": (
            "{criterion} is not determined by the certification tests: legs that pass them gi"
            "ve {low:.4g} to {high:.4g} {unit}."
        ),
        "certificate-test-missing": "{procedure} is missing: the logbook has no test of it.",
        "certificate-test": "{procedure} is {verdict:verdict}: {reasons:list}.",
        "certificate-criteria": "{criteria:list} {verdict:verdict}",
        "certificate-no-limits": "no limits are known to grade it by",
        "certificate-overdue": "On the day of issue a certification is due: {rule} ({why}).",
        "certificate-scope": "Rests on the last measured test of each procedure of the legform {serial}, by “{rules}”; not a calibration certificate of its sensors.",
        # Decision rules.
        "simple-acceptance": "simple acceptance",
        "guard-band": "guard band w = {ratio:g}·U (ILAC-G8:09/2019)",
        # Why a criterion has no value, or this verdict.
        "channel-not-recorded": "channel `{channel}` was not recorded",
        "channel-empty": "channel `{channel}` is empty",
        "channel-not-finite": "channel `{channel}`: {bad} of its {count} values are not numbers",
        "channel-unusable": "channel `{channel}`: {reason}",
        "channel-filtered-narrower": (
            "channel `{channel}` was already filtered with {seen}, narrower than {wanted}"
        ),
        "sampled-too-slowly": (
            "sampled at {rate:.6g} Hz, CFC {frequency_class:g} needs at least {needed:g} Hz; "
            "export the channel at its full sampling rate"
        ),
        "too-short-to-filter": "{count} sample(s) cannot be filtered",
        "not-finite-to-filter": (
            "a value that is not a number cannot be filtered; mend or leave out the channel"
        ),
        "nothing-recorded": "nothing was recorded from {start:.6g} to {end:.6g} ms after contact",
        "level-never-reached": "{channel} never reaches {level}",
        "no-assessment-interval": "no assessment interval: {reason}",
        "channel-dead": "it moves by {swing:.3g} {unit} only while the other channels show a blow: dead, torn off or not connected",
        "channel-frozen": "it stands still from {time:.1f} ms on while the other channels move",
        "gauge-turned": "it moves against the other gauges of its bone ({others:list}): its sign is turned",
        "moves-wrong-way": "it is shortened by {least:.3g} {unit} where the blow lengthens it (largest elongation {most:.3g} {unit}): turned or torn off",
        "unit-out-by-ten": "{value:.3g} {unit} is out by a factor of {factor:g} against {others:list}: check the unit",
        "impossible-step": "it jumps by {step:.3g} {unit} within one sample at {time:.2f} ms; a leg allows {limit:.3g} {unit}",
        "channel-copied": "its noise is that of {other}: one sensor, recorded twice",
        "drifts-at-rest": "{channel} drifts at rest, by {share:.2g} % of its peak until then: its sensor or amplifier is not steady.",
        "swings-at-rest": "{channel} swings at rest by {share:.2g} % of its peak: hum or noise that the filter does not take away.",
        "drop-out": "it jumps by {step:.3g} {unit} away from its course at {time:.2f} ms and is back at {back:.2f} ms",
        "clipped": "its top is cut off flat at {level:.4g} {unit} from {time:.2f} ms on: the peak is lost",
        "record-begins-late": "the record begins {start:.4g} ms after contact; what came before is not known",
        "loaded-before-contact": "it shows {value:.4g} {unit} at or before contact: the record begins late, or time zero is wrong",
        "peak-at-first-sample": "the largest value stands at the first sample, {time:.2f} ms: a flank, no peak",
        "peak-at-last-sample": "the largest value stands at the last sample, {time:.2f} ms: a flank, no peak",
        "record-ends-early": "the record ends at {end:.4g} ms with {share:.0%} of the peak left: the peak cannot be known to be over",
        "moment-pattern": "{channel} lies {share:.0%} of the largest moment off the line between {others:and}; no leg bends so: check gauges and order.",
        "accepted-leniently": "Accepted with --lenient, not shown by the data: {reason}.",
        "corridor-not-graded": "{corridors} also has {entries:list}, which this procedure does not grade.",
        "interval-rests-on-doubt": "the assessment interval rests on {channel}: {reason}",
        "interval-end-decides": "{criterion}: the assessment interval is a knife edge: another end by 2 ms moves the value by {moved:.3g} {unit}, the margin is {margin:.3g} {unit}.",
        "peak-near-interval": "{criterion}: a larger peak of {value:.4g} {unit} lies at {time:.1f} ms, just outside of the assessment interval that ends at {end:.1f} ms.",
        "pass-rests-on-peaks": "Rests on {count} peaks inside the record ({start:.4g} to {end:.4g} ms), each of a channel that moves as its neighbours do; nearest to its limit is {criterion}, by {margin:.3g} {unit}.",
        "pass-rests-on-limits": "Rests on the limits of {origins:list}.",
        "limit-origin": "{set} ({confidence:word})",
        "pass-rests-on-model": "Rests on the model {model}, which no known fit aimed at these limits.",
        "pass-rests-on-fitted-model": "Rests on the model {model}, {fits:and}: that it meets them says that the fit worked, and predicts nothing.",
        "fitted-to-corridors": "which the fit {fit} aimed at these very corridors",
        "fitted-to-reference": "which the fit {fit} aimed at the reference of this test",
        "pass-rests-on-conditions": "Rests on conditions that were recorded and kept: {conditions:and}{rest:join}.",
        "calibrations-valid": "; {count} calibrations that cover the day of the test",
        "simulated-by-others": "A virtual test: simulated by another program, graded here; not a test of a legform.",
        "conditions-open": "; not recorded, and not required: {conditions:list}",
        "fitted-on-bounds": "Fitted values that stand on a bound of the fit {fit}: {parameters:list}.",
        "group-travel": "travel of a front's group",
        "hold-the-groups": "a group flies into the car: its springs do not hold it",
        "group-room": "travel of a group over the room behind it",
        "hold-the-group": "{group} goes further than there is room: stiffen what holds it, or mend its `room`",
        "spring-range": "shortening of a spring over its curve's end",
        "extract-further": "{spring} is shortened beyond its curve: extract it from a run that goes as far",
        "spring-beyond-range": "The spring {spring} was shortened by {shortening:.4g} mm, beyond the {last:.4g} mm that its curve reaches: its force there is continued, not known.",
        "bone-still-rising": "{channel} is still rising at the record's end ({value:.4g} N·m at {end:.4g} ms)",
        "bone-not-back-to-zero": "{channel} is not back at zero when the record ends ({value:.4g} N·m, {end:.4g} ms)",
        "bones-lowered-too-far": "all bone moments would have to be lowered by {shift:.4g} N·m for {channel} to cross zero, more than {most:g} % of its {highest:.4g} N·m",
        "bone-moments-small": "no bone moment has a maximum beyond {marginal:g} N·m",
        "no-corridor": "no corridor is known",
        "corridor-set-not-found": "the corridor set `{set}` was not found",
        "corridor-set-for-other": "the corridor set `{set}` is for the {impactor}",
        "corridor-not-in-set": "the corridor set `{set}` has no `{entry}`",
        "single-point": "a single point is no curve",
        "curve-covers-little": (
            "the curve runs through {covered:.0%} of the corridor only; {needed:.0%} is needed"
        ),
        "recorded-too-short": (
            "recorded from {start:.4g} to {end:.4g} ms, "
            "the corridor reaches from {corridor_start:.4g} to {corridor_end:.4g} ms"
        ),
        "no-sample-under-corridor": "no sample lies under the corridor",
        "value-not-finite": "the value is not a number",
        "corridor-without-limit": "the corridor has no limit",
        "uncertainty-not-finite": "the expanded uncertainty is not a number",
        "uncertainty-missing": "the guard band needs an expanded uncertainty for this channel",
        "inside-guard-band": "inside the corridor, but within the guard band",
        "within-numerical-uncertainty": (
            "nearer to its limit than its numerical uncertainty of {uncertainty:.2g} {unit}"
        ),
        # Conditions of the test.
        "condition-not-recorded": "{quantity} was not recorded",
        "condition-not-recorded-not-required": "{quantity} was not recorded; it is not required",
        "condition-not-finite": "{quantity} is not a number",
        "condition-not-finite-not-required": "{quantity} is not a number; it is not required",
        "condition-outside": "{quantity} {value:.4g} {unit} is outside {lower} to {upper}",
        "equipment-expired": "the calibration of {equipment} expired on {day}; the test was on {tested}",
        "equipment-calibrated-later": "{equipment} was calibrated on {day} only; the test was on {tested}",
        "sensor-expired": (
            "the calibration of sensor {sensor} ({channel}) expired on {day}; the test was on {tested}"
        ),
        "sensor-calibrated-later": (
            "the calibration of sensor {sensor} ({channel}) was calibrated on {day} only; "
            "the test was on {tested}"
        ),
        # Limits of the numerical quality gate.
        "energy-balance": "energy balance",
        "joint-gap": "joint gap",
        "penetration": "penetration",
        "step-change": "change when the step is halved",
        "flesh-depth": "flesh depth over its thickness",
        # Notes on recording and conditioning.
        "note-of-criteria": "{criteria:list}: {text}",
        "note-of-channel": "{channel}: {reason}",
        "filters": "Filters: {edition}, run forward and backward.",
        "assessment-interval": (
            "Assessment interval 0–{end:.1f} ms, ended by {channel} crossing zero{details:join}."
        ),
        "interval-lowered": " after all bone moments were lowered by {shift:.1f} N·m",
        "interval-left-out": "; {channels:list} stay within {marginal:g} N·m and take no part",
        "clipped-kept": "clipped at {level:.6g} {unit} from {time:.3f} ms on; kept because of --lenient",
        "time-zero-moved": "time zero moved by {by:+.2f} ms to the first contact, found on {channel}",
        "no-offset-removed": (
            "no offset removed: less than {needed:g} ms at rest were recorded before contact"
        ),
        "offset-removed": "offset {offset:.4g} {unit} removed",
        "offsets-removed": ("offsets of bone and ligament channels removed over {start:.1f} to {end:.1f} ms"),
        "sign-turned": "sign turned: polarity was swapped",
        "assumed": "{place}: {fault}; assumed: {assumption}",
        "left-out": "{fault}; assumed: {channel} was not recorded",
        "questionable-data": "{place}: data status is `questionable data`",
        "recorded-twice": "{channel} was recorded twice; {code} is used",
        "moves-before-contact": "moves by {share:.0f} % of its peak before contact, while the others are at rest",
        "header-says-other": "{words}: the data say {data}, the laboratory file {laboratory}",
        "recorded-by-other-procedure": "recorded by the procedure {made}, graded by {graded}",
        "status-not-good": "{channel} is not used: {place}: data status is `{status}`",
        "prefiltered": "{place}: was filtered by the amplifier with {filter}; counts as not filtered",
        "codes-not-used": "not used: {codes:list}",
        "kind-not-said": "{file} does not say whether it was simulated; taken as measured",
        # Error tables and comparisons.
        "not-in-rms": "Not measured, so not in the rms error: {criteria:list}.",
        "published-rounded": (
            "Published errors are rounded to whole percent, as they were printed, and so is their rms."
        ),
        "only-in": "Only in {test}: {channels:list}.",
        "values-of-criteria": "Values are those of the criteria.",
        "values-of-peaks": (
            "Values are the peaks of the channels, {filter}, on the side where the reference has its peak."
        ),
        "reference-nearly-zero": (
            "The reference is nearly zero, so there is no relative error: {channels:list}."
        ),
        "rated-too-slow": "sampled too slowly for a rating at 10 kHz",
        "rated-lengths-differ": (
            "the curves to be rated have different lengths; bring them on one time axis first"
        ),
        "rated-too-short": "{count} samples are too few to be rated: {needed} at 10 kHz are needed",
        "rated-not-finite": "a curve with values that are not numbers cannot be rated",
        "rated-constant": "the reference is constant; there is nothing to rate against",
    }
)
