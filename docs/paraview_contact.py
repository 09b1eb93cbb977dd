# The contact of the glass pair in ParaView, without a window:
#
#     fem-run cases/glass_0.5ms.toml
#     xvfb-run -a pvbatch docs/paraview_contact.py
#
# writes contact.png: both halves, deformed, the stress along the axis from -1 to 1 GPa.
from paraview import simple as pv

reader = pv.PVDReader(FileName="runs/glass_0.5ms/glass_0.5ms.pvd")
maximum = reader.TimestepValues[1]
deformed = pv.WarpByVector(Input=reader)
deformed.Vectors = ["POINTS", "displacement"]
deformed.ScaleFactor = 1
whole = pv.Reflect(Input=deformed)
whole.Plane = "X Min"

view = pv.CreateView("RenderView")
view.ViewSize = [900, 700]
view.ViewTime = maximum
view.CameraParallelProjection = 1
view.CameraFocalPoint = [0, 0, 0]
view.CameraPosition = [0, 0, 1]
view.CameraParallelScale = 4e-4
shown = pv.Show(whole, view)
pv.ColorBy(shown, ("POINTS", "sigma_yy"))
colours = pv.GetColorTransferFunction("sigma_yy")
colours.ApplyPreset("Cool to Warm", True)
colours.RescaleTransferFunction(-1e9, 1e9)
shown.SetScalarBarVisibility(view, True)
bar = pv.GetScalarBar(colours, view)
bar.TitleColor = bar.LabelColor = [0, 0, 0]
pv.SaveScreenshot("contact.png", view)

points = whole.GetDataInformation().GetPointDataInformation()
stress = points.GetArrayInformation("sigma_yy").GetComponentRange(0)
pressure = points.GetArrayInformation("contact_pressure").GetComponentRange(0)
print(f"sigma_yy from {stress[0]:.3g} Pa, pressure up to {pressure[1]:.3g} Pa")
# What docs/paraview.md prints of the files themselves.
assert -1.05e9 < stress[0] < -0.95e9 and 0.95e9 < pressure[1] < 1.05e9
