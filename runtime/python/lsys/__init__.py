# SPDX-License-Identifier: MIT
"""L-systems: compile grammars, derive words, draw and mesh plants.

    >>> import lsys
    >>> grammar = lsys.compile(text="#n = 2; #w : A; #p : A : * : F [ + A ] F A;")
    >>> str(grammar.derive())
    'F[+F[+A]FA]FF[+A]FA'
"""

import html
import os

import numpy as np

from . import _lsys, arguments as _arguments, picture as _picture
from ._lsys import (
    FORMATS,
    INSTANCE,
    INSTANCE_GROUP,
    OBJECT,
    OBJECT_KINDS,
    POLYGON,
    PRESETS,
    SEGMENT,
    TREE,
    Constant,
    Diagnostic,
    Edit,
    Fix,
    Forest,
    ForestCounts,
    Grammar,
    Instances,
    Label,
    Mesh,
    ModuleKind,
    Place,
    Plant,
    PlantSize,
    PredictedSize,
    Species,
    Word,
    __version__,
)
from .errors import Cancelled, GrammarError, GrammarWarning, LimitError, LsysError

__all__ = [
    "FORMATS", "INSTANCE", "INSTANCE_GROUP", "OBJECT", "OBJECT_KINDS", "POLYGON", "PRESETS",
    "SEGMENT", "TREE",
    "Cancelled", "Constant", "Diagnostic", "Edit", "Fix", "Forest", "ForestCounts", "Grammar",
    "GrammarError", "GrammarWarning", "Instances", "Label", "LimitError", "LsysError", "Mesh",
    "ModuleKind", "Place", "Plant", "PlantSize", "PredictedSize", "Species", "Word", "compile",
    "options", "__version__",
]


def compile(path=None, *, text=None, name="grammar.lsys", defines=None, settings=None,
            generations=None, dialect="", system="", bug_compatible=False, **options):
    """Compiles a grammar: the file `path`, or `text` under the name `name`.

    defines: values of `#define` and `#param` by name.
    settings: values of `#set` by key: numbers, texts, or sequences of numbers.
    generations: replaces `#n`.
    dialect: "lsys", "cpfg" ...; empty: recognised by the contents and the name.
    options: threads, max_modules, max_bytes, untrusted, root, max_seconds, max_output, progress,
        read_file, environment, as for all calls.

    Raises GrammarError with the mistakes, LsysError if a file cannot be read.
    """
    if (path is None) == (text is None):
        raise TypeError("compile() takes either a path or text=...")
    arguments = {
        "defines": dict(defines or {}),
        "settings": dict(settings or {}),
        "generations": generations,
        "dialect": dialect,
        "system": system,
        "bug_compatible": bug_compatible,
    }
    if text is not None:
        return _lsys.compile_text(text, name, **arguments, **options)
    return _lsys.compile_file(os.fspath(path), **arguments, **options)


def options(of):
    """The options of save() for a "plant" or a "forest", or of Forest() for a "scene".

    Returns a dictionary. Its keys are names with dashes; each value is a pair of the form of the
    option's value (empty for a flag) and a help text."""
    return _lsys.options(of)


def _save(plant, path, *, mesh=None, preset=None, **options):
    """Writes the plant to a file and the files beside it. Returns the paths of all files.

    The extension of `path` selects the format, unless the option `format` is given.

    preset: "web", "unreal", "unity", "godot", "blender" or "print". options: the options of
    `lsc export` with underscores, as in `lods=6`, `wind=(8, 0, 0, 0.5)`, `wind_data=True`, and the
    options of all calls. All files appear when they are complete, or none. None replaces a file
    that the plant was made from.
    mesh: writes this mesh, unchanged, to one file; the options are then only format, compress, up.
    """
    path = os.fspath(path)
    if mesh is None:
        calls, named = _arguments.split({"preset": preset, **options})
        return plant._save(path, named, **calls)
    if preset is not None:
        raise TypeError("a preset makes meshes of its own: leave out either preset or mesh")
    kind = options.pop("format", None) or _lsys.format_of_path(path)
    if not kind:
        raise LsysError(f"`{path}` has no extension of a known format: {', '.join(FORMATS)}")
    stem = os.path.splitext(os.path.basename(path))[0]
    return plant._save_mesh(mesh, path, kind, name=stem, **options)


def _save_forest(forest, path, *, preset=None, **options):
    """Writes the forest to a file and the pictures beside it. Returns the paths of all files.

    The extension of `path` selects the format.

    preset: "web", "unreal", "unity", "godot" or "blender". options: the options of
    `lsc forest` for files with underscores, as in `instances="lods"`, and the options of all calls.
    All files appear when they are complete, or none.
    """
    calls, named = _arguments.split({"preset": preset, **options})
    return forest._save(os.fspath(path), named, **calls)


def _write(model, name, receive, **options):
    """Like save(), but passes each file in pieces to `receive(name, bytes, is_last)`, which ends
    the call by returning False. Returns the names of the files."""
    calls, named = _arguments.split(options)
    return model._write(name, receive, named, **calls)


def _files(model, name, **options):
    """Like save(), but returns the files: a dictionary from name to bytes."""
    files = {}

    def receive(part, piece, _):
        files.setdefault(part, bytearray()).extend(piece)

    _write(model, name, receive, **options)
    return {part: bytes(data) for part, data in files.items()}


def _svg(plant):
    """The plant as a drawing in SVG, seen from the front."""
    return plant.export(plant.mesh(), "svg").decode()


def _png(plant, width=320, height=400):
    """The plant as a picture in PNG, seen from the front."""
    mesh = plant.mesh(tangents=False, texture_coordinates=False)
    return _picture.png(_picture.draw(mesh, width, height))


def _html(text, picture):
    """A figure of HTML with `picture`, an SVG, and `text` without its angle brackets below it."""
    caption = html.escape(text.strip("<>"))
    return f"<figure>{picture}<figcaption>{caption}</figcaption></figure>"


def _plant_html(plant):
    """The plant as a drawing with its measures."""
    svg = plant._repr_svg_()
    return _html(repr(plant), svg[svg.index("<svg"):])


def _forest_svg(forest):
    """The trees seen from above, a colour for each species."""
    trees = forest.trees
    size = 400
    if len(trees) == 0:
        return f'<svg xmlns="http://www.w3.org/2000/svg" width="{size}" height="{size}"></svg>'
    at = trees["position"][:, [0, 2]].astype(np.float64)
    low, high = at.min(axis=0), at.max(axis=0)
    extent = max((high - low).max(), 1e-9)
    places = 10 + (at - low) / extent * (size - 20)
    shown = np.linspace(0, len(trees) - 1, min(len(trees), 5000)).astype(np.int64)
    colours = ("#2f6d32", "#8a5a2b", "#3c78a8", "#b08d2e", "#6b4a8a", "#a04b4b")
    dots = "".join(
        f'<circle cx="{places[i, 0]:.1f}" cy="{places[i, 1]:.1f}" r="2" '
        f'fill="{colours[trees["species"][i] % len(colours)]}"/>' for i in shown)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{size}" height="{size}" '
            f'viewBox="0 0 {size} {size}">{dots}</svg>')


def _plant_repr(plant):
    return (f"<Plant of {plant.generations} generations: {len(plant.segments):,} segments, "
            f"{len(plant.objects):,} objects, {len(plant.polygons):,} polygons>")


def _word_repr(word):
    return f"<Word of generation {word.generation}: {len(word):,} modules>"


def _grammar_repr(grammar):
    return f"<Grammar {grammar.name}>"


def _mesh_repr(mesh):
    return (f"<Mesh: {len(mesh.positions):,} vertices, {sum(p[2] for p in mesh.parts) // 3:,} "
            f"triangles>")


def _forest_repr(forest):
    names = ", ".join(species.name for species in forest.species)
    return f"<Forest of {len(forest.trees):,} trees: {names}>"


def _instances_repr(instances):
    return (f"<Instances: {len(instances):,} in {len(instances.groups):,} groups of "
            f"{len(instances.meshes)} meshes>")


def _matrices(instances):
    """The transforms as an array of (instances, 4, 4) float32: `m[i] @ (x, y, z, 1)` is a vertex of
    instance i."""
    matrices = np.empty((len(instances), 16), np.float32)
    instances.read_matrices(matrices)
    return matrices.reshape(-1, 4, 4).transpose(0, 2, 1)


def _forest_new(cls, scene, *, defines=None, settings=None, generations=None, **options):
    """Makes the forest whole: no function could use one without a value."""
    files = [os.fspath(scene)] if isinstance(scene, (str, os.PathLike)) else [
        os.fspath(path) for path in scene]
    calls, named = _arguments.split(options)
    forest = _lsys._grow_forest(files, None, named, dict(defines or {}), dict(settings or {}),
                                generations, **calls)
    if cls is not Forest:
        forest.__class__ = cls
    return forest


def _forest_init(self, scene, *, defines=None, settings=None, generations=None, **options):
    """Grows the forest of a scene file (.toml), or of one grammar or several, each of which is a
    species.

    defines, settings, generations: of all grammars, as for compile(). options: options of
    `lsc forest`, with underscores, that replace values of the scene, as in `count=500`,
    `placement="poisson-disk"`, `rho=0`, and the options of all calls.
    """
    # _forest_new() has grown the forest already.


def _whole(name, values, most):
    """Whole numbers from 0 to `most`; assigning others to an integer array would change them."""
    values = np.asarray(values)
    if values.dtype.kind not in "iufb" or not np.all((values >= 0) & (values <= most)) or not np.all(
            values == np.floor(values)):
        raise ValueError(f"{name} is a whole number from 0 to {most}")
    return values


def _from_places(grammars, positions, *, rotation=0.0, scale=1.0, key=None, species=0, age=0,
                 defines=None, settings=None, generations=None, **options):
    """Grows trees at places. Each argument of places is an array with an item for each tree, or a
    single value.

    grammars: one path or several. positions: (trees, 3), m. rotation: radians about +Y. key: a
    number that determines the branches of a tree; None: its index. species: index in `grammars`.
    age: years; 0: the last stage, which has the most generations. Other arguments: as for Forest().
    """
    positions = np.asarray(positions, np.float32)
    if positions.ndim != 2 or positions.shape[1] != 3:
        raise ValueError("positions is an array of (trees, 3)")
    places = np.zeros(len(positions), TREE)
    places["position"] = positions
    places["yaw"] = rotation
    places["scale"] = scale
    places["number"] = np.arange(len(positions)) if key is None else _whole(
        "key", key, 2**32 - 1)
    places["species"] = _whole("species", species, 2**16 - 1)
    places["age"] = _whole("age", age, 2**16 - 1)
    files = [os.fspath(grammars)] if isinstance(grammars, (str, os.PathLike)) else [
        os.fspath(path) for path in grammars]
    calls, named = _arguments.split(options)
    return _lsys._grow_forest(files, places, named, dict(defines or {}), dict(settings or {}),
                              generations, **calls)


def _instances(forest):
    """The branches of all trees, made when first asked for; make_instances() has options."""
    made = forest.__dict__.get("_instances")
    if made is None:
        made = forest.__dict__["_instances"] = forest.make_instances()
    return made


Plant.save = _save
Plant.write = _write
Plant.files_of = _files
Plant.svg = _svg
Plant.png = _png
Plant._repr_svg_ = _svg
Plant._repr_png_ = _png
Plant._repr_html_ = _plant_html
Plant.__repr__ = _plant_repr
Word.__repr__ = _word_repr
Grammar.__repr__ = _grammar_repr
Mesh.__repr__ = _mesh_repr
_forest_new.__qualname__ = "Forest"  # in messages about its arguments
Forest.__new__ = staticmethod(_forest_new)
Forest.__init__ = _forest_init
Forest.from_places = staticmethod(_from_places)
Forest.instances = property(_instances)
Forest.save = _save_forest
Forest.write = _write
Forest.files_of = _files
Forest._repr_svg_ = _forest_svg
Forest._repr_html_ = lambda self: _html(repr(self), _forest_svg(self))
Forest.__repr__ = _forest_repr
Instances.matrices = _matrices
Instances.__repr__ = _instances_repr
