"""VTK, which ParaView draws with, reads the Radiance picture of a sky and the bare voxels of a cloud, and draws both.

The sky has the values of the manifest's probes in the directions that VTK's skybox documents for them. The cloud is
seen from above, one column of voxels to a pixel: black before white, its picture is exp(-optical depth), where the
optical depth is the trapezoid rule over the column's voxels, which are all that VTK interpolates between.
"""

import array
import math
import os
import subprocess
import sys
from pathlib import Path

import consumer

DIGIT = 1 / 255  # of a picture


def display():
    """A screen of its own, on which VTK draws without a GPU."""
    program = consumer.program("Xvfb", "xvfb")
    read, write = os.pipe()
    screen = subprocess.Popen([program, "-displayfd", str(write), "-screen", "0", "640x480x24"], pass_fds=[write],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.environ["DISPLAY"] = ":" + os.read(read, 16).decode().strip()
    return screen


def window_of(vtk, renderer, size):
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(*size)
    window.AddRenderer(renderer)
    return window


def picture(vtk, window):
    """The image that the window shows, whose row 0 is the lowest."""
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.SetInputBufferTypeToRGB()
    grab.ReadFrontBufferOff()
    grab.Update()
    return grab.GetOutput()


def check_texels(failures, image, sky):
    """The reader has the lowest row first."""
    width, height, _ = image.GetDimensions()
    failures.expect([width, height], sky.size, "the size of the picture that VTK reads")
    for channel, statistics in enumerate(sky.statistics()):
        values = [image.GetScalarComponentAsFloat(x, y, 0, channel) for y in range(height) for x in range(width)]
        failures.expect((min(values), max(values)), (statistics["min"], statistics["max"]), f"extremes of channel {channel}")
        failures.expect_near(sum(values) / len(values), statistics["mean"], 1e-6, f"the mean of channel {channel}")


def check_sky(failures, vtk, sky):
    reader = vtk.vtkHDRReader()
    reader.SetFileName(sky.path("hdr"))
    reader.Update()
    check_texels(failures, reader.GetOutput(), sky)
    texture = vtk.vtkTexture()
    texture.SetInputConnection(reader.GetOutputPort())
    texture.SetColorModeToDirectScalars()
    texture.MipmapOff()
    texture.InterpolateOn()
    box = vtk.vtkSkybox()
    box.SetTexture(texture)
    box.SetProjectionToSphere()
    renderer = vtk.vtkRenderer()
    renderer.AddActor(box)
    window = window_of(vtk, renderer, (1, 1))
    camera = renderer.GetActiveCamera()
    camera.SetViewAngle(0.01)
    seen = 0
    for i, probe in enumerate(sky.asset["probes"]):
        azimuth, elevation = (math.radians(probe["at"][name]) for name in ("azimuth_deg", "elevation_deg"))
        if abs(azimuth) > math.radians(178) or abs(elevation) > math.radians(89):
            continue  # VTK's sphere has a seam behind, and a camera that looks up no upward direction
        seen += 1
        # vtkOpenGLSkybox has the middle of the picture at -z and its right half at +x.
        camera.SetFocalPoint(math.sin(azimuth) * math.cos(elevation), math.sin(elevation), -math.cos(azimuth) * math.cos(elevation))
        camera.SetPosition(0, 0, 0)
        camera.SetViewUp(0, 1, 0)
        renderer.ResetCameraClippingRange()
        image = picture(vtk, window)
        for c, value in enumerate(probe["value"]):
            found = image.GetScalarComponentAsFloat(0, 0, 0, c) * DIGIT
            failures.expect_near(found, min(value, 1), 1.5 * DIGIT + probe["tolerance"][c], f"probe {i} of VTK's sky, channel {c}")
    window.Finalize()
    failures.expect(seen >= 12, True, f"whether {seen} probes are many")


def read_cloud(vtk, cloud, step, low):
    reader = vtk.vtkImageReader()
    reader.SetFileName(cloud.path("bin"))
    reader.SetFileDimensionality(3)
    reader.SetDataScalarTypeToFloat()
    reader.SetDataByteOrderToLittleEndian()
    reader.FileLowerLeftOn()  # row 0 is the first one
    reader.SetDataExtent(*(end for n in cloud.size for end in (0, n - 1)))
    reader.SetDataSpacing(*step)
    reader.SetDataOrigin(*(l + s / 2 for l, s in zip(low, step)))
    reader.Update()
    return reader


def volume_of(vtk, reader, extinction, step, densest):
    """A black volume whose opacity over a length is 1 - exp(-extinction length)."""
    mapper = vtk.vtkGPUVolumeRayCastMapper()
    mapper.SetInputConnection(reader.GetOutputPort())
    mapper.SetAutoAdjustSampleDistances(0)
    mapper.SetSampleDistance(step[2] / 32)
    opacity, color = vtk.vtkPiecewiseFunction(), vtk.vtkColorTransferFunction()
    for i in range(1025):
        density = densest * i / 1024
        opacity.AddPoint(density, 1 - math.exp(-extinction * density * step[2]))
    color.AddRGBPoint(0, 0, 0, 0)
    look = vtk.vtkVolumeProperty()
    look.SetInterpolationTypeToLinear()
    look.ShadeOff()
    look.SetScalarOpacityUnitDistance(step[2])
    look.SetScalarOpacity(opacity)
    look.SetColor(color)
    volume = vtk.vtkVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(look)
    return volume


def check_cloud(failures, vtk, cloud):
    low, high = ([cloud.asset["mapping"][axis][end] for axis in "uvw"] for end in ("first", "last"))
    step = [(h - l) / n for l, h, n in zip(low, high, cloud.size)]
    densities = array.array("f", Path(cloud.path("bin")).read_bytes())
    extinction = cloud.asset["details"]["extinction_scale_per_m"]
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddVolume(volume_of(vtk, read_cloud(vtk, cloud, step, low), extinction, step, max(densities)))
    width, height, depth = cloud.size
    window = window_of(vtk, renderer, (width, height))
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale((high[1] - low[1]) / 2)
    camera.SetPosition((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, high[2] + 1000)
    camera.SetFocalPoint((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2])
    camera.SetViewUp(0, 1, 0)
    renderer.ResetCameraClippingRange()
    seen = picture(vtk, window)
    shades = set()
    for y in range(1, height - 1):  # VTK's volume ends in the middle of the outer voxels
        for x in range(1, width - 1):
            column = [densities[(z * height + y) * width + x] for z in range(depth)]
            wanted = math.exp(-extinction * step[2] * (sum(column) - (column[0] + column[-1]) / 2))
            shades.add(round(50 * wanted))
            found = seen.GetScalarComponentAsFloat(x, y, 0, 0) * DIGIT
            failures.expect_near(found, wanted, 0.015, f"the light through column ({x}, {y})")
    window.Finalize()
    failures.expect(len(shades) > 5, True, f"whether {sorted(shades)} are many shades")


def main():
    try:
        import vtk
    except ImportError:
        consumer.skip("there is no module vtk (python3-vtk9)")
    failures = consumer.Failures()
    cloud, sky = consumer.baked_volumes()
    screen = display()
    try:
        check_sky(failures, vtk, sky)
        check_cloud(failures, vtk, cloud)
    finally:
        screen.kill()
    sys.stdout.flush()
    failures.exit()


main()
