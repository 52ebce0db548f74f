"""Ten kinds of pairs of curves for the ISO/TS 18571 rating: reference and signal, 0.2 s at 10 kHz."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

TIME = np.arange(2000) * 1e-4


def _pulse(start: float = 0.0, height: float = 250.0, width: float = 0.012) -> Floats:
    return height * np.exp(-(((TIME - 0.04 - start) / width) ** 2))


def _ringing(frequency: float, decay: float) -> Floats:
    return np.sin(2 * np.pi * frequency * TIME) * np.exp(-decay * TIME)


PAIRS = {
    "equal": (_pulse(), _pulse()),
    "scaled": (_pulse(), 1.2 * _pulse()),
    "late": (_pulse(), _pulse(0.003)),
    "early": (_pulse(), _pulse(-0.006)),
    "noisy": (_pulse(), _pulse() + 5.0 * np.sin(2 * np.pi * 1234.5 * TIME)),
    "wider": (_pulse(), _pulse(0.001, 230.0, 0.015)),
    "ringing": (_ringing(50, 10), _ringing(52, 14)),
    "rebound": (_pulse(), _pulse() - 0.4 * _pulse(0.04)),
    "steps": (np.where(TIME > 0.05, 1.0, 0.0) + 0.001 * TIME, np.where(TIME > 0.055, 0.9, 0.0)),
    "far too late": (_pulse(), _pulse(0.06)),
    "distorted": (np.sin(20 * TIME), np.sin(20 * TIME) ** 3),
}
