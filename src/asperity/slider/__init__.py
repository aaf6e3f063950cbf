"""A body pulled over a vibrating base: march, periodic state, homogenised law, closed forms.

:Entry: `solve` (one case), `solve_many` (side by side), `homogenise` (a law in place of the
    vibration); `slide`, the command `asperity slide`.
:Data: `[slider]` and `[solve]` (`parameters`), `[friction]`, `[vibration]`, `[normal]`, `[wear]`;
    `model` puts them together.
:Where: `march` and `kernels` (over time), `periodic` and `shooting` (a state that repeats),
    `homogenised`, `static` (breaking away), `pressed` (load normal to the plane), `step_error`,
    `closed_forms`, `batch` (lanes).
:Tests: `unit/test_march`, `unit/test_shooting`, `unit/test_slider_*`,
    `literature/test_sliding_body`, `property/test_slider*`.

>>> from asperity.friction import Friction
>>> from asperity.slider import Model, Slider, solve
>>> from asperity.vibration import Vibration
>>> body = Slider(drive_velocity="0.5 mm/s", normal_force="55 N")
>>> contact = Friction(mu=0.1, max_deflection="68.75 nm")
>>> shaken = Vibration(frequency="4 kHz", velocity_ratio=6.0, start="0.01 s")
>>> round(solve(Model(body, contact, shaken)).ratio, 3)
0.159
"""

from asperity.results.ledger import PowerLedger
from asperity.runs import Stopped
from asperity.slider.batch import solve_many
from asperity.slider.friction_map import FrictionMap
from asperity.slider.history import History
from asperity.slider.homogenised import HomogenisedLaw, homogenise
from asperity.slider.model import Model
from asperity.slider.parameters import Slider, Solve
from asperity.slider.result import SlideResult
from asperity.slider.slide import solve
from asperity.slider.tables import TABLES

__all__ = [
    "TABLES",
    "FrictionMap",
    "History",
    "HomogenisedLaw",
    "Model",
    "PowerLedger",
    "SlideResult",
    "Slider",
    "Solve",
    "Stopped",
    "homogenise",
    "solve",
    "solve_many",
]
