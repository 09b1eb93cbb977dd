#!/usr/bin/env python3
"""Runs what `fem-run export` writes for MuJoCo, Drake and Newton in these programs, and compares restitutions.

    check_robotics.py EXPORT_FOLDER

mujoco and drake are from PyPI; so is newton (1.8.0), which runs too where it is installed. A sphere meets another one of the same pair head on at the slowest, the
middle and the fastest speed of the data, in steps of a thousandth of the contact.
"""

import importlib.util
import json
import math
import pathlib
import re
import sys
import xml.etree.ElementTree

# Steps of a thousandth of the contact time leave some 1e-4 of the restitution.
STEPS_A_CONTACT = 1000
TOLERANCE = 5e-4
# Of the rebound of the patch over mu v_n: its friction is regularised.
PATCH_TOLERANCE = 0.05
# Newton's positions are in single precision: their rounding is a thousandth of the overlap of the slowest impact.
TOLERANCES = {"Newton": 5e-3}


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
    return (data.qvel[8] - data.qvel[2]) / speed, None


def in_drake(folder, export, speed, across=0.0):
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
    # The line of centres is upright halfway through the contact.
    start = -0.5 * across * export["linear_contact_time_s"]
    plant.SetFreeBodyPose(own, bodies[0], RigidTransform([start, 0, 0]))
    plant.SetFreeBodyPose(own, bodies[1], RigidTransform([0, 0, sum(radii) + 1e-9]))
    plant.SetFreeBodySpatialVelocity(own, bodies[0], SpatialVelocity([0, 0, 0], [across, 0, speed]))
    step = export["linear_contact_time_s"] / STEPS_A_CONTACT
    ResetIntegratorFromFlags(simulator, "runge_kutta2", step)
    simulator.get_mutable_integrator().set_fixed_step_mode(True)
    simulator.AdvanceTo(4 * export["linear_contact_time_s"])
    after = [plant.EvalBodySpatialVelocityInWorld(own, body) for body in bodies]
    (x0, _, z0), (x1, _, z1) = (velocity.translational() for velocity in after)
    turning = sum(radius * velocity.rotational()[1] for radius, velocity in zip(radii, after))
    return (z1 - z0) / speed, x0 - x1 + turning


def in_newton(folder, export, speed):
    import newton
    import warp

    warp.config.quiet = True
    text = (folder / "newton_material.usda").read_text()
    stiffness, damping = (
        float(re.search(key + r" = (\S+)", text)[1]) for key in ("contactStiffness", "contactDamping")
    )
    builder = newton.ModelBuilder(gravity=(0.0, 0.0, 0.0))
    shape = newton.ModelBuilder.ShapeConfig(ke=stiffness, kd=damping, kf=0.0, mu=0.0, ka=0.0)
    radii = [0.5 * sphere["diameter_m"] for sphere in export["spheres"]]
    for radius, sphere, height in zip(radii, export["spheres"], (0.0, sum(radii) + 1e-8)):
        shape.density = sphere["density_kg_m3"]
        body = builder.add_body(xform=warp.transform((0, 0, height), warp.quat_identity()))
        builder.add_shape_sphere(body, radius=radius, cfg=shape)
    builder.body_qd[0] = (0, 0, speed, 0, 0, 0)
    model = builder.finalize(device="cpu")
    state, following = model.state(), model.state()
    solver = newton.solvers.SolverSemiImplicit(model)
    pipeline = newton.CollisionPipeline(model)
    contacts = pipeline.contacts()
    for _ in range(3 * STEPS_A_CONTACT):
        state.clear_forces()
        pipeline.collide(state, contacts)
        step = export["linear_contact_time_s"] / STEPS_A_CONTACT
        solver.step(state, following, model.control(), contacts, step)
        state, following = following, state
    velocities = state.body_qd.numpy()[:, 2]
    return (velocities[1] - velocities[0]) / speed, None


def main(folder):
    folder = pathlib.Path(folder)
    export = json.loads((folder / "export.json").read_text())
    snippets = {snippet["code"]: snippet for snippet in export["snippets"]}
    points = export["data"]
    codes = [("MuJoCo", in_mujoco), ("Drake", in_drake)]
    if importlib.util.find_spec("newton"):
        codes.append(("Newton", in_newton))
    for code, run in codes:
        for k in (0, len(points) // 2, len(points) - 1):
            speed, wanted = points[k]["speed_m_s"], snippets[code]["restitutions_at_data"][k]
            made, _ = run(folder, export, speed)
            print(f"{code:7} {speed:.4f} m/s: makes {made:.5f}, said {wanted:.5f}")
            tolerance = TOLERANCES.get(code, TOLERANCE)
            assert math.isclose(made, wanted, abs_tol=tolerance), (code, speed, made, wanted)

    friction = export["friction"]
    if not friction:
        return
    speed = friction["approach_speed_m_s"]
    scale = friction["coefficient"] * speed
    for x, wanted in list(zip(friction["patch_before"], snippets["Drake"]["friction"]["patch_after"]))[::4]:
        _, patch = in_drake(folder, export, speed, x * scale)
        print(f"Drake   tan(angle)/mu {x:.2f}: patch {patch / scale:+.4f}, said {wanted:+.4f}")
        assert math.isclose(patch / scale, wanted, abs_tol=PATCH_TOLERANCE), (x, patch / scale, wanted)


if __name__ == "__main__":
    main(sys.argv[1])
