"""What compare_builds.py runs: every shipped case with every model, scenes, faults, all commands.

A job is a few commands in one folder, which holds the checkout's `cases` and `validation`. A key of
a case that is new gets a scene here, a new law or model a line.
"""

import itertools
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
GLASS, WALL, ICE = "cases/glass_0.5ms.toml", "cases/glass_on_wall.toml", "cases/ice_2cm.toml"
ELASTIC, ELASTIC_BULK = "cases/glass_0.5ms_elastic.toml", "cases/glass_0.5ms_elastic_bulk.toml"
SWEEPS = ["cases/sweep_glass.toml", "cases/sweep_speed.toml"]
DATA = "validation/data"

LAWS = [
    "linear={k=1e7, c=30}",
    'linear={e=0.9, contact_time="60 us", end="zero_overlap"}',
    "power={k=3e9, gamma=1.5, c=3e4, n=0.5}",
    "hertz={}",
    "kuwabara_kono={}",
    'kuwabara_kono={a="1 us"}',
    'kuwabara_kono={eta_1="2e4 Pa*s", eta_2="1e4 Pa*s"}',
    "hunt_crossley={e=0.9}",
    'hunt_crossley={e=0.9, v="0.3 m/s"}',
    "tsuji={e=0.9}",
    'tsuji={alpha=0.1, end="zero_overlap"}',
    "zhang_whiten={e=0.9}",
    "zhang_whiten={alpha=0.1, tolerance=1e-6}",
    "falcon={c=300}",
    "mishra_murty={k=1e10, c=3e5}",
    'schwager_poeschel={a="1 us"}',
    'schwager_poeschel={eta_1="2e4 Pa*s", eta_2="1e4 Pa*s"}',
    'morgado_oppenheim={eta_1="2e4 Pa*s", eta_2=0.3}',
    'bordbar_hyppanen={a="0.3 us", n=0.65}',
]
MODELS = [
    "fem={}",
    "condensed={}",
    "condensed={vibration_modes=12}",
    "condensed={penalty_springs=true}",
    "condensed={vibration_modes=3, steps=200, penalty_springs=true}",
    "hertz={}",
    "hertz={finite_size=true}",
    "ting={}",
    "ting={finite_size=true}",
    "ting={tolerance=1e-5}",
    *(f"law.{law}" for law in LAWS),
]
# One model of each kind; the last law takes its numbers from the materials.
KINDS = ["fem={}", "condensed={}", "condensed={vibration_modes=12}", "hertz={}", "ting={}",
         "law.tsuji={e=0.9}", "law.kuwabara_kono={}"]

COARSE = ['mesh.contact_element_size="80 um"', 'mesh.refined_radius="0.3 mm"']
SOFT = ["material.glass={density=2390, youngs_modulus=1e6, poissons_ratio=0.244}",
        'mesh.contact_element_size="0.5 mm"']


def relaxation(acts_on, *terms):
    terms = ", ".join(f"{{weight={weight}, {time}}}" for weight, time in terms)
    return f'material.glass.relaxation={{acts_on="{acts_on}", terms=[{terms}]}}'


SCENES = [
    [GLASS, "output.snapshots=5"],
    [GLASS, 'output.snapshots=["10 us", 3e-5, 1]'],
    [GLASS, "output.snapshots=[]"],
    [GLASS, 'output.snapshots=["last-contact", "maximum"]', 'start.gap="1 um"',
     'body.1.approach_speed="-10 cm/s"'],
    [GLASS, relaxation("shear", (0.6, "decay_rate=2708"), (0.2, 'relaxation_time="10 us"'))],
    # The bodies stay together.
    [GLASS, relaxation("all", (1, 'relaxation_time="5 us"')), *COARSE],
    # The contact outgrows the condensed region, which is then made larger.
    [GLASS, relaxation("all", (0.98, 'relaxation_time="0.1 us"')), *COARSE],
    # It outgrows the region that explicit elements search, and at 30 m/s the sphere: the run fails.
    [GLASS, *SOFT, "body.0.approach_speed=10"],
    [GLASS, *SOFT, "body.0.approach_speed=30"],
    [GLASS, 'material.steel={density=7850, shear_modulus="81 GPa", bulk_modulus="175 GPa"}',
     'body.1.material="steel"', 'body.1.approach_speed="20 cm/s"'],
    [GLASS, 'body.1.sphere.diameter="22.2 mm"', "body.0.approach_speed=20"],
    [GLASS, 'body.1={name="wall", wall={}, approach_speed=0.2}', "output.snapshots=3"],
    [WALL, "body.0.approach_speed=0.3", "start.gap=2e-6", 'effects.finite_strain="off"'],
    [GLASS, "mesh.contact_element_size=50e-6", "mesh.growth=1.3", "contact.penalty_factor=0.5",
     "time.step_factor=0.5", "time.mass_scaling=0"],
    # Refused.
    [GLASS, "limits.elements=1000"],
    [GLASS, "limits.element_updates=1e6"],
    [GLASS, 'limits.memory="1 MB"'],
    [GLASS, 'effects.mirror_symmetry="on"'],
    [GLASS, "body.0.approach_speed=-1"],
]
# Refused, or a run that fails or warns.
FAULTS = [
    "model.law.tsuji={}",
    "model.law.hooke={}",
    "model.auto={}",
    "model.condensed={steps=1}",
    "model.condensed={vibration_modes=100}",
    "model.law.power={k=1e9, gamma=1.5, c=1e300, n=5}",
    'model.law.linear={k=1e7, c=1e9, end="zero_overlap"}',
    'material.glass.density="1 m"',
    "mesh.size=1",
    'output.snapshots=["middle"]',
    'body.1.material="steel"',
    'body.0.sphere.mesh="absent.vtu"',
]

# A model that fails, all others of a kind; snapshots are kept.
VARIED = f"""case = "{GLASS}"
keep = "all"

[vary]
model = [
    {{ fem = {{}} }},
    {{ condensed = {{}} }},
    {{ ting = {{}} }},
    {{ law = {{ linear = {{ k = 1e7, c = 1e9, end = "zero_overlap" }} }} }},
]
"body.0.approach_speed" = ["0.2 m/s", "0.5 m/s", "1 m/s"]
"""
CRADLE = ["cradle", "--length", "20 cm ± 1 mm", "--diameters", "22.2 mm,15.9 mm"]
CLAIMS = ["condensed_explicit", "condensed_limits", "condensed_ting", "contact_patch",
          "critical_step", "default_settings", "invariance", "kratos", "paper_contours",
          "paper_restitution", "paper_velocities", "uniform_stress"]
COMMANDS = ["check", "mesh", "sweep", "measure", "fit", "calibrate", "invert", "export",
            "cradle", "completions"]


class Job(NamedTuple):
    """Commands that run one after the other in one folder, and files that they find there."""

    commands: list
    files: dict = {}


def on(case, *overrides):
    """Arguments for a case with other values for some keys."""
    return [case, *(f"--set={override}" for override in overrides)]


def run_and_check(case, *overrides):
    return [[*on(case, *overrides), "--out", "result"], ["check", *on(case, *overrides)]]


def model_commands(cases):
    for case, model in itertools.product(cases, MODELS):
        yield from run_and_check(case, f"model.{model}")
    for scene, kind in itertools.product(SCENES, KINDS):
        yield from run_and_check(*scene, f"model.{kind}")
    for fault in FAULTS:
        yield from run_and_check(GLASS, fault)


def short_commands(cases):
    """Meshes, laws, the cradle and calibrations that take less than a second; help."""
    yield from (["mesh", case, "--out", "meshes"] for case in cases)
    yield [*CRADLE, "--alpha", "20 deg ± 0.2 deg", "--beta", "28.3 ± 0.2 deg"]
    yield [*CRADLE, "--data", f"{DATA}/cradle_trials.csv", "--angle-uncertainty", "0.1 deg"]
    point = [GLASS, "--data", f"{DATA}/paper_glass.csv"]
    yield ["calibrate", *point]
    yield ["calibrate", *point, "--model", "ting", "--acts-on", "shear"]
    yield ["fit", *point, "--law", "ting"]
    yield ["fit", *point, "--law", "bordbar_hyppanen", "--param", "n=1"]
    yield ["fit", *point, "--law", "bordbar_hyppanen", "--free", "a,n"]
    yield ["invert", GLASS, "--restitution", "0.92"]
    yield ["invert", *on(GLASS, "model.law.tsuji={e=0.9}"), "--restitution", "0.5"]
    yield ["invert", GLASS, "--law", "hunt_crossley", "--restitution", "0.1"]
    times = ["measure", f"{DATA}/bounce_times.csv"]
    yield from (times, [*times, "--height", "50 cm ± 1 mm"])
    yield [*times, "--diameter", "10 mm", "--density", "7800 kg/m^3", "--contact-time", "50 us"]
    yield from ([*times, "--gravity", "0"], [*times, "--kind", "force"], [*times, "--rest", "2 s"])
    yield from (["measure", f"{DATA}/ball_track.csv"], ["measure", f"{DATA}/ball_force.csv"])
    yield ["measure", f"{DATA}/ball_force.csv", "--mass", "10 g ± 0.02 g", "--height", "3 cm ± 0.1 mm"]
    yield ["validate", "--list"]
    yield ["completions", "bash"]
    yield from ([*command, "--help"] for command in ([], *([name] for name in COMMANDS)))


def long_commands():
    """What takes seconds."""
    ice = [ICE, "--data", f"{DATA}/bridges_ice.csv"]
    yield ["calibrate", *ice]
    pairings = ["calibrate", GLASS, "--data", f"{DATA}/synthetic_pairings.csv"]
    yield from (pairings, [*pairings, "--model", "ting"])
    fit = ["fit", *ice, "--law", "bordbar_hyppanen", "--compare", "kuwabara_kono", "--at", "1 cm/s"]
    yield from ([*fit, "--free", "a,n"], [*fit, "--param", "n=0.65"], [*fit, "--robust"])
    yield ["invert", ELASTIC_BULK, "--law", "ting", "--restitution", "0.92"]
    yield from (["export", GLASS], ["export", *on(GLASS, 'body.1={name="wall", wall={}}')])
    yield ["export", *on(GLASS, 'model.law.kuwabara_kono={a="1 us"}')]
    yield ["export", *on(WALL, "model.law.tsuji={e=0.9}"), "--speeds", "5 cm/s..2 m/s"]
    yield from (["validate", claim, "--out", "page"] for claim in CLAIMS)
    for sweep, models in itertools.product(SWEEPS, ([], ["condensed={}"], ["ting={}"])):
        yield ["sweep", *on(sweep, *(f"model.{model}" for model in models)), "--threads", "1"]


def sweep_jobs():
    """A sweep with shared factors, and what is made of its table; shards, and the whole again."""
    made = ["--data", "runs/sweep_glass/sweep.csv"]
    yield Job([["sweep", *on(SWEEPS[0], "model.condensed={}", *COARSE), "--threads", "4"],
               ["calibrate", *on(GLASS, *COARSE), *made],
               ["fit", GLASS, *made, "--law", "kuwabara_kono"],
               ["export", GLASS, *made]])
    sweep = ["sweep", "varied.toml", "--threads", "1"]
    shards = ([*sweep, "--shard", shard] for shard in ("1/2", "2/2"))
    yield Job([*shards, sweep], {"varied.toml": VARIED})


def all_jobs():
    """The longest first: they end while others still run."""
    shipped = sorted(f"cases/{path.name}" for path in (ROOT / "cases").glob("*.toml"))
    cases = [case for case in shipped if case not in SWEEPS]
    commands = [*long_commands(), *short_commands(cases), *model_commands(cases)]
    return [*sweep_jobs(), *(Job([command]) for command in commands)]


def quick_jobs():
    cases = [GLASS, WALL]
    return [Job([command]) for command in (*short_commands(cases), *model_commands(cases))]
