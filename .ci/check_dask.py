"""A sweep on Dask: a scheduler and two workers, processes all, one of which is killed in the middle. The table has
to be the one that this process computes alone."""

import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from distributed import Client

import fem_run

ROOT = pathlib.Path(__file__).resolve().parents[1]


def main():
    case = fem_run.Case.load(ROOT / "cases" / "glass_0.5ms.toml")
    case = case.with_({"model": {"fem": {}}, "mesh.contact_element_size": "50 um"})
    vary = {"body.0.approach_speed": np.geomspace(0.2, 2, 40)}
    local = fem_run.sweep(case, vary)

    with tempfile.TemporaryDirectory() as folder:
        address = os.path.join(folder, "scheduler.json")
        dask = [sys.executable, "-m", "dask"]
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": folder}
        scheduler = ["scheduler", "--scheduler-file", address, "--port", "0", "--dashboard-address", ":0"]
        worker = ["worker", "--scheduler-file", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"]
        processes = [subprocess.Popen([*dask, *scheduler], **quiet)]
        processes += [subprocess.Popen([*dask, *worker], **quiet) for _ in range(2)]
        try:
            with Client(scheduler_file=address, timeout="60s") as client:
                client.wait_for_workers(2, timeout=60)
                victim, killed_at = processes[1], []

                def report(fraction):
                    if fraction >= 0.25 and not killed_at:
                        killed_at.append(fraction)
                        victim.kill()

                spread = fem_run.sweep(case, vary, executor=client.get_executor(), progress=report)
                n_workers = len(client.scheduler_info()["workers"])
        finally:
            for process in processes:
                process.kill()
                process.wait()
    assert killed_at and killed_at[0] < 1 and n_workers == 1, (killed_at, n_workers)
    assert spread.to_csv() == local.to_csv()
    print(f"40 members on two workers, one killed after {killed_at[0]:.0%}: the same bytes as computed here")


if __name__ == "__main__":
    main()
