"""What the rendering scripts share: VTK without a screen, small PNG files, colours."""

import os
import shutil
import struct
import sys
import zlib


def need_display():
    """Starts the program again under xvfb-run when there is no X display: Debian's VTK renders through GLX only."""
    if os.environ.get("DISPLAY") or not sys.platform.startswith("linux"):
        return
    if not shutil.which("xvfb-run"):
        sys.exit("render: error: no display and no xvfb-run: install the packages xvfb and xauth")
    os.execvp("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset", sys.executable] + sys.argv)


need_display()

import numpy  # noqa: E402
import vtk  # noqa: E402
from vtk.util.numpy_support import vtk_to_numpy  # noqa: E402

# Pastel colours that stay apart from their neighbours in the list.
PALETTE = [(0.71, 0.78, 0.86), (0.95, 0.76, 0.55), (0.60, 0.78, 0.64), (0.87, 0.60, 0.58), (0.72, 0.65, 0.83), (0.94, 0.87, 0.58),
           (0.55, 0.75, 0.80), (0.86, 0.70, 0.78), (0.76, 0.80, 0.55), (0.65, 0.68, 0.90), (0.93, 0.66, 0.70), (0.62, 0.84, 0.78)]


def read(path):
    """The unstructured grid of a mesh artifact (.hdf) or an export (.vtu)."""
    if not os.path.isfile(path):
        sys.exit(f"render: error: '{path}' does not exist")
    reader = vtk.vtkXMLUnstructuredGridReader() if path.endswith(".vtu") else vtk.vtkHDFReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    if grid is None or grid.GetNumberOfCells() == 0:
        sys.exit(f"render: error: VTK finds no cells in '{path}'")
    return grid


def cell_array(grid, name):
    """Cell data as numpy, or a clear end when the file has none of this name."""
    array = grid.GetCellData().GetArray(name)
    if array is None:
        names = [grid.GetCellData().GetArrayName(i) for i in range(grid.GetCellData().GetNumberOfArrays())]
        sys.exit(f"render: error: no cell data '{name}' (there is: {', '.join(names) or 'none'})")
    return vtk_to_numpy(array)


def actor(data, colour=(0.8, 0.8, 0.8), line_width=1.0):
    """Actor of one colour for poly data."""
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    result = vtk.vtkActor()
    result.SetMapper(mapper)
    result.GetProperty().SetColor(*colour)
    result.GetProperty().SetLineWidth(line_width)
    return result


SAMPLES = 2  # rendered pixels per pixel of the picture and direction: faster than multisampling in software, and lines can be thinner than a pixel


def window_of(renderer, size):
    """Off-screen window whose picture will have the given size."""
    renderer.SetBackground(1, 1, 1)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(*(SAMPLES * n for n in size))
    window.AddRenderer(renderer)
    return window


def axes(direction):
    """Unit vectors to the right, up and towards the viewer."""
    out = numpy.array(direction) / numpy.linalg.norm(direction)
    right = numpy.cross((0, 0, 1), out)
    right /= numpy.linalg.norm(right)
    return right, numpy.cross(out, right), out


def fit(points, direction, size):
    """Focus and half height of the picture (width, height) that shows all points."""
    frame = axes(direction)
    low, high = zip(*((float((points @ axis).min()), float((points @ axis).max())) for axis in frame))
    focus = sum(0.5 * (a + b) * axis for a, b, axis in zip(low, high, frame))
    return focus, 0.52 * max(high[1] - low[1], (high[0] - low[0]) * size[1] / size[0])


def look(renderer, focus, direction, half_height):
    """Parallel projection onto `focus`, seen from `direction`, showing `half_height` above and below it."""
    direction = numpy.array(direction, float) / numpy.linalg.norm(direction)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*focus)
    camera.SetPosition(*(numpy.array(focus) + 1000 * half_height * direction))
    camera.SetViewUp(*((0, 0, 1) if abs(direction[2]) < 0.99 else (1, 0, 0)))
    camera.SetParallelScale(half_height)
    renderer.ResetCameraClippingRange()


def write_png(window, path, n_colours=256):
    """Renders and writes a PNG with a palette: about a third of the size of true colour."""
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    average = vtk.vtkImageShrink3D()
    average.SetInputConnection(grab.GetOutputPort())
    average.SetShrinkFactors(SAMPLES, SAMPLES, 1)
    average.MeanOn()
    quantise = vtk.vtkImageQuantizeRGBToIndex()
    quantise.SetInputConnection(average.GetOutputPort())
    quantise.SetNumberOfColors(n_colours)
    quantise.Update()
    image = quantise.GetOutput()
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width)[::-1].astype(numpy.uint8)
    table = quantise.GetLookupTable()
    palette = b"".join(bytes(int(round(255 * c)) for c in table.GetTableValue(i)[:3]) for i in range(table.GetNumberOfTableValues()))
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)) + chunk(b"PLTE", palette)
                  + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))
    print(f"{path}  {os.path.getsize(path) // 1000} kB")
