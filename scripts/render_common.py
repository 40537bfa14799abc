"""What the rendering scripts share: VTK without a screen, small PNG files, colours."""

import json
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
PALETTE = [(0.71, 0.78, 0.86), (0.95, 0.76, 0.55), (0.60, 0.78, 0.64), (0.87, 0.60, 0.58), (0.72, 0.65, 0.83),
           (0.94, 0.87, 0.58), (0.55, 0.75, 0.80), (0.86, 0.70, 0.78), (0.76, 0.80, 0.55), (0.65, 0.68, 0.90),
           (0.93, 0.66, 0.70), (0.62, 0.84, 0.78)]


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


# rendered pixels per pixel of the picture and direction: faster than multisampling in software, and lines can
# be thinner than a pixel
SAMPLES = 2


def window_of(renderer, size):
    """Off-screen window whose picture will have the given size."""
    renderer.SetBackground(1, 1, 1)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(*(SAMPLES * n for n in size))
    window.AddRenderer(renderer)
    return window


def upright(out):
    """The axis that a picture has upwards, seen from direction `out` of length 1."""
    return (0, 0, 1) if abs(out[2]) < 0.99 else (1, 0, 0)


def axes(direction):
    """Unit vectors to the right, up and towards the viewer."""
    out = numpy.array(direction) / numpy.linalg.norm(direction)
    right = numpy.cross(upright(out), out)
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
    camera.SetViewUp(*upright(direction))
    camera.SetParallelScale(half_height)
    renderer.ResetCameraClippingRange()


GRID = (8, 5)  # columns and rows of what a picture remembers
STALE = 0.20  # share of what a picture shows that may differ from what it would show now: no reader sees less


def shown(points, focus, direction, half_height, size):
    """What a picture shows, coarsely: how many of the points (of triangles, of cells) lie in each part of it."""
    right, up, _ = axes(direction)
    offsets = numpy.asarray(points) - numpy.array(focus)
    half_width = half_height * size[0] / size[1]
    columns = numpy.floor((offsets @ right / half_width + 1) / 2 * GRID[0]).astype(int)
    rows = numpy.floor((offsets @ up / half_height + 1) / 2 * GRID[1]).astype(int)
    inside = (columns >= 0) & (columns < GRID[0]) & (rows >= 0) & (rows < GRID[1])
    counts = numpy.bincount(rows[inside] * GRID[0] + columns[inside], minlength=GRID[0] * GRID[1])
    return [int(n) for n in counts]


def remembered(path):
    """What the picture showed when it was made, or None: its text chunk "shows"."""
    if not os.path.isfile(path):
        return None
    with open(path, "rb") as file:
        data = file.read()
    at = 8
    while at + 8 <= len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"tEXt" and body.startswith(b"shows\0"):
            return json.loads(body[6:])
        at += 12 + length
    return None


def is_current(path, shows):
    """Whether a picture still shows what it would show now; prints the verdict."""
    name, before = os.path.basename(path), remembered(path)
    if before is None or len(before) != len(shows):
        print(f"STALE: {name}: it does not exist, or does not say what it shows; make it again")
        return False
    old, new = numpy.array(before, float), numpy.array(shows, float)
    difference = float(numpy.abs(old - new).sum() / max(1.0, (old + new).sum() / 2))
    verdict = "ok" if difference <= STALE else "STALE"
    print(f"{verdict}: {name}: {int(old.sum())} things shown, {int(new.sum())} now, {100 * difference:.1f} % differ")
    return difference <= STALE


def write_png(window, path, shows=None, n_colours=256):
    """Renders and writes a PNG with a palette: about a third of the size of true colour. It remembers what it shows."""
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
    palette = b"".join(bytes(int(round(255 * c)) for c in table.GetTableValue(i)[:3])
                       for i in range(table.GetNumberOfTableValues()))
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    text = b"" if shows is None else chunk(b"tEXt", b"shows\0" + json.dumps(shows).encode())
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)) + text +
                  chunk(b"PLTE", palette)
                  + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))
    print(f"{path}  {os.path.getsize(path) // 1000} kB")
