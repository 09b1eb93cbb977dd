"""Draws sigma_yy of a result folder's snapshots side by side.

    pip install meshio matplotlib
    python docs/images/sigma_yy.py runs/glass_0.5ms docs/images/sigma_yy.png
"""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import meshio
import numpy as np

folder, picture = Path(sys.argv[1]), sys.argv[2]
collection = next(folder.glob("*.pvd"))
datasets = ElementTree.parse(collection).getroot().iter("DataSet")
snapshots = [(float(d.get("timestep")), d.get("file")) for d in datasets]

plt.rcParams.update({"font.size": 9, "font.family": "DejaVu Sans"})
figure, axes = plt.subplots(1, len(snapshots), figsize=(2.6 * len(snapshots) + 0.8, 3.0),
                            sharey=True, layout="constrained")
levels = np.linspace(-1.025, 0.025, 22)  # zero lies inside of a band
for axis, (time, name) in zip(np.atleast_1d(axes), snapshots):
    grid = meshio.read(folder / name)
    position = 1e3 * (grid.points + grid.point_data["displacement"])[:, :2]
    centre = position[np.hypot(*grid.points[:, :2].T) == 0.0, 1].mean()
    quads = grid.cells[0].data
    triangles = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    stress = 1e-9 * grid.point_data["sigma_yy"]
    for side in (-1.0, 1.0):
        filled = axis.tricontourf(side * position[:, 0], position[:, 1] - centre, triangles,
                                  stress, levels=levels, cmap="viridis", extend="both")
        for body in (0, 1):
            cells = quads[grid.cell_data["body"][0] == body]
            edges = np.sort(np.vstack([cells[:, [k, (k + 1) % 4]] for k in range(4)]), axis=1)
            edges, counts = np.unique(edges, axis=0, return_counts=True)
            edges = edges[(counts == 1) & (grid.points[edges, 0] > 0.0).any(axis=1)]
            for edge in edges:
                axis.plot(side * position[edge, 0], position[edge, 1] - centre, "k-", lw=0.6)
    axis.set(xlim=(-0.6, 0.6), ylim=(-0.6, 0.6), aspect="equal", xlabel="r / mm")
    label = name.rsplit("_", 1)[1].removesuffix(".vtu").replace("-", " ")
    axis.set_title(f"{label}\n{1e6 * time:.1f} µs", fontsize=9)
axes[0].set_ylabel("y / mm")
figure.colorbar(filled, ax=axes, label="σyy / GPa", shrink=0.9)
figure.savefig(picture, dpi=150)
