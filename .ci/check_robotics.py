#!/usr/bin/env python3
"""Runs what `fem-run export` writes for MuJoCo and Drake in these programs, and compares restitutions.

    check_robotics.py EXPORT_FOLDER

mujoco and drake are from PyPI. A sphere meets another one of the same pair head on at the slowest, the
middle and the fastest speed of the data, in steps of a thousandth of the contact.
"""

import json
import math
import pathlib
import sys
import xml.etree.ElementTree

# Steps of a thousandth of the contact time leave some 1e-4 of the restitution.
STEPS_A_CONTACT = 1000
TOLERANCE = 5e-4


def in_mujoco(folder, export, speed):
    import mujoco

    model = xml.etree.ElementTree.parse(folder / "mujoco_contact.xml").getroot()
    step = export["linear_contact_time_s"] / STEPS_A_CONTACT
    option = model.find("option")
    option.set("timestep", repr(step))
    option.set("gravity", "0 0 0")
    world = xml.etree.ElementTree.SubElement(model, "worldbody")
    radii = [0.5 * sphere["diameter_m"] for sphere in export["spheres"]]
    places = [0.0, sum(radii) + 1e-9]
    for radius, place, sphere in zip(radii, places, export["spheres"]):
        body = xml.etree.ElementTree.SubElement(world, "body", pos=f"0 0 {place!r}")
        xml.etree.ElementTree.SubElement(body, "freejoint")
        density = sphere["density_kg_m3"]
        xml.etree.ElementTree.SubElement(
            body, "geom", type="sphere", size=repr(radius), density=repr(density)
        )
    model = mujoco.MjModel.from_xml_string(xml.etree.ElementTree.tostring(model, "unicode"))
    data = mujoco.MjData(model)
    data.qvel[2] = speed
    for _ in range(4 * STEPS_A_CONTACT):
        mujoco.mj_step(model, data)
    return (data.qvel[8] - data.qvel[2]) / speed


def in_drake(folder, export, speed):
    from pydrake.geometry import Sphere
    from pydrake.math import RigidTransform
    from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
    from pydrake.multibody.tree import SpatialInertia
    from pydrake.multibody.math import SpatialVelocity
    from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator
    from pydrake.systems.framework import DiagramBuilder

    given = {}
    exec((folder / "drake_point_contact.py").read_text(), given)
    builder = DiagramBuilder()
    plant, scene = AddMultibodyPlantSceneGraph(builder, time_step=0.0)
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, 0.0])
    radii = [0.5 * sphere["diameter_m"] for sphere in export["spheres"]]
    bodies = []
    for k, (radius, sphere) in enumerate(zip(radii, export["spheres"])):
        inertia = SpatialInertia.SolidSphereWithDensity(sphere["density_kg_m3"], radius)
        body = plant.AddRigidBody(f"ball{k}", inertia)
        plant.RegisterCollisionGeometry(
            body, RigidTransform(), Sphere(radius), f"ball{k}", given["properties"]
        )
        bodies.append(body)
    plant.Finalize()
    diagram = builder.Build()
    simulator = Simulator(diagram)
    context = simulator.get_mutable_context()
    own = plant.GetMyMutableContextFromRoot(context)
    plant.SetFreeBodyPose(own, bodies[0], RigidTransform())
    plant.SetFreeBodyPose(own, bodies[1], RigidTransform([0, 0, sum(radii) + 1e-9]))
    plant.SetFreeBodySpatialVelocity(own, bodies[0], SpatialVelocity([0, 0, 0], [0, 0, speed]))
    step = export["linear_contact_time_s"] / STEPS_A_CONTACT
    ResetIntegratorFromFlags(simulator, "runge_kutta2", step)
    simulator.get_mutable_integrator().set_fixed_step_mode(True)
    simulator.AdvanceTo(4 * export["linear_contact_time_s"])
    after = [plant.EvalBodySpatialVelocityInWorld(own, body).translational()[2] for body in bodies]
    return (after[1] - after[0]) / speed


def main(folder):
    folder = pathlib.Path(folder)
    export = json.loads((folder / "export.json").read_text())
    snippets = {snippet["code"]: snippet for snippet in export["snippets"]}
    points = export["data"]
    for code, run in (("MuJoCo", in_mujoco), ("Drake", in_drake)):
        for k in (0, len(points) // 2, len(points) - 1):
            speed, wanted = points[k]["speed_m_s"], snippets[code]["restitutions_at_data"][k]
            made = run(folder, export, speed)
            print(f"{code:7} {speed:.4f} m/s: makes {made:.5f}, said {wanted:.5f}")
            assert math.isclose(made, wanted, abs_tol=TOLERANCE), (code, speed, made, wanted)


if __name__ == "__main__":
    main(sys.argv[1])
