"""L-systems: compile grammars, derive words, draw and mesh plants.

    >>> import lsys
    >>> grammar = lsys.compile(text="#n = 2; #w : A; #p : A : * : F [ + A ] F A;")
    >>> str(grammar.derive())
    'F[+F[+A]FA]FF[+A]FA'
"""

import os

from . import _lsys
from ._lsys import (
    FORMATS,
    OBJECT,
    OBJECT_KINDS,
    POLYGON,
    SEGMENT,
    Constant,
    Diagnostic,
    Edit,
    Fix,
    Grammar,
    Label,
    Mesh,
    ModuleKind,
    Place,
    Plant,
    PlantSize,
    PredictedSize,
    Word,
    __version__,
)
from .errors import Cancelled, GrammarError, GrammarWarning, LimitError, LsysError

__all__ = [
    "FORMATS", "OBJECT", "OBJECT_KINDS", "POLYGON", "SEGMENT",
    "Cancelled", "Constant", "Diagnostic", "Edit", "Fix", "Grammar", "GrammarError",
    "GrammarWarning", "Label", "LimitError", "LsysError", "Mesh", "ModuleKind", "Place", "Plant",
    "PlantSize", "PredictedSize", "Word", "compile", "__version__",
]


def compile(path=None, *, text=None, name="grammar.lsys", defines=None, settings=None,
            generations=None, dialect="", system="", bug_compatible=False, **options):
    """Compiles a grammar: the file `path`, or `text` under the name `name`.

    defines: values of `#define` and `#param` by name.
    settings: values of `#set` by key: numbers, texts, or sequences of numbers.
    generations: instead of `#n`.
    dialect: "lsys", "cpfg" ...; empty: recognised by the contents and the name.
    options: threads, max_modules, max_bytes, progress, read_file, as for all calls.

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


def _save(plant, path, *, mesh=None, format=None, compress="none", up="y", **options):
    """Writes the plant to a file. `format` or else the extension of the file sets the format.

    mesh: of plant.mesh(); None: made with its defaults. compress: "none", "quantize" or "meshopt",
    for glb and gltf. up: "y" or "z". Pictures are in the file or, as in OBJ, left out. The file
    appears when it is complete.
    """
    path = os.fspath(path)
    kind = format or _lsys.format_of_path(path)
    if not kind:
        raise LsysError(f"the name `{path}` does not tell a format: {', '.join(FORMATS)}")
    stem = os.path.splitext(os.path.basename(path))[0]
    data = plant.export(mesh if mesh is not None else plant.mesh(), kind, name=stem,
                        compress=compress, up=up, **options)
    unfinished = f"{path}.{os.getpid()}.part"
    try:
        with open(unfinished, "xb") as file:
            file.write(data)
        os.replace(unfinished, path)
    except BaseException:
        if os.path.exists(unfinished):
            os.unlink(unfinished)
        raise


def _svg(plant):
    """The plant as a drawing in SVG, seen from the front."""
    return plant.export(plant.mesh(), "svg").decode()


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


Plant.save = _save
Plant.svg = _svg
Plant._repr_svg_ = _svg
Plant.__repr__ = _plant_repr
Word.__repr__ = _word_repr
Grammar.__repr__ = _grammar_repr
Mesh.__repr__ = _mesh_repr
