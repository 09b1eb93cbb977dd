"""How do two viscoelastic spheres collide?

Collisions are computed by the same code as the command ``fem-run``, with the same bits::

    import fem_run, numpy as np
    case = fem_run.Case.load("cases/glass_0.5ms.toml")
    result = case.with_({"body.0.approach_speed": "1 m/s"}).run()
    result.restitution, result.history["contact_force_n"]
    table = fem_run.sweep(case, {"body.0.approach_speed": np.geomspace(0.05, 2, 40)})

Bare numbers are SI, strings carry a unit (``"22.2 mm"``). Invalid input raises :class:`InputError` with the
message of the command.
"""

from ._case import Case
from ._errors import Error, InputError, Interrupted, RunError
from ._laws import calibrate, check, cradle, export, fit, invert, measure, relaxation
from ._materials import materials
from ._result import Result, Snapshot
from ._sweep import Table, sweep


def __getattr__(name: str) -> str:
    """Returns the version, which is looked up on request."""
    if name != "__version__":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib.metadata import version

    return version("fem-run")


__all__ = [
    "Case",
    "Error",
    "InputError",
    "Interrupted",
    "Result",
    "RunError",
    "Snapshot",
    "Table",
    "calibrate",
    "check",
    "cradle",
    "export",
    "fit",
    "invert",
    "materials",
    "measure",
    "relaxation",
    "sweep",
]
