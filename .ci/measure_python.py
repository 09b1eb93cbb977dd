"""What Python adds: the size of the wheel, the time of an import, and of a thousand condensed collisions beside the
command. `measure_python.py WHEEL COMMAND`; prints the rows of docs/python.md."""

import pathlib
import subprocess
import sys
import tempfile
import time

import fem_run

ROOT = pathlib.Path(__file__).resolve().parents[1]
N = 1000


def best(work, n):
    """The least of some times, s: other work on the machine only adds."""

    def once():
        start = time.perf_counter()
        work()
        return time.perf_counter() - start

    return min(once() for _ in range(n))


def main(wheel, command):
    def python(code):
        return best(lambda: subprocess.run([sys.executable, "-c", code], check=True), 7)

    imported = python("import fem_run") - python("import numpy")

    changes = {"model": {"condensed": {}}, "mesh.contact_element_size": "40 um", "mesh.refined_radius": "0.4 mm"}
    case = fem_run.Case.load(ROOT / "cases" / "glass_0.5ms.toml").with_(changes)
    speeds = [0.2 + 1.8 * k / (N - 1) for k in range(N)]
    own = best(lambda: fem_run.sweep(case, {"body.0.approach_speed": speeds}, threads=1), 3)
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        (place / "case.toml").write_text(case.to_toml())
        (place / "sweep.toml").write_text(
            f"case = 'case.toml'\n[vary]\nbody.0.approach_speed = {speeds}\n"
        )
        outs = iter(range(100))

        def run():
            words = [command, "sweep", "sweep.toml", "--threads", "1", "--quiet", "--out", f"out{next(outs)}"]
            subprocess.run(words, cwd=place, check=True)

        of_command = best(run, 3)
    print(f"| wheel | {pathlib.Path(wheel).stat().st_size / 1e6:.1f} MB |")
    print(f"| `import fem_run`, numpy imported | {1e3 * imported:.0f} ms |")
    print(f"| a condensed collision, one of {N} on one thread, by `fem_run.sweep` | {1e3 * own / N:.2f} ms |")
    print(f"| the same by `fem-run sweep` | {1e3 * of_command / N:.2f} ms |")


if __name__ == "__main__":
    main(*sys.argv[1:])
