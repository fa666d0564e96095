# SPDX-License-Identifier: MIT
"""Types of the package lsys. Arrays that are views are read-only.

Lengths are in metres, masses in kilograms; +Y is up."""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Literal, Optional, TypedDict, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

from .errors import (
    Cancelled as Cancelled,
    GrammarError as GrammarError,
    GrammarWarning as GrammarWarning,
    LimitError as LimitError,
    LsysError as LsysError,
)

_Path = Union[str, "os.PathLike[str]"]
_Receive = Callable[[str, bytes, bool], Optional[bool]]  # name, bytes, is_last; False ends the call
_Setting = Union[str, float, Sequence[Union[str, float]]]
# Arguments: generation, positions, headings, ups, parameters.
_Environment = Callable[
    [int, NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float32]],
    ArrayLike,
]
_CallOptions = TypedDict(
    "_CallOptions",
    {
        "threads": int,
        "max_modules": int,
        "max_bytes": int,
        "untrusted": bool,
        "root": _Path,
        "max_seconds": float,
        "max_output": int,
        "progress": Optional[Callable[[int, int, int], Optional[bool]]],
        "read_file": Optional[Callable[[str], Union[str, bytes, None]]],
        "environment": Optional[Mapping[str, _Environment]],
    },
    total=False,
)

__version__: str
FORMATS: list[str]
PRESETS: list[str]
OBJECT_KINDS: list[str]
SEGMENT: np.dtype[np.void]
OBJECT: np.dtype[np.void]
POLYGON: np.dtype[np.void]
TREE: np.dtype[np.void]
INSTANCE: np.dtype[np.void]
INSTANCE_GROUP: np.dtype[np.void]

class Place:  # lines and columns from 1; offsets in bytes; the end is exclusive
    @property
    def file(self) -> str: ...
    @property
    def line(self) -> int: ...
    @property
    def column(self) -> int: ...
    @property
    def end_line(self) -> int: ...
    @property
    def end_column(self) -> int: ...
    @property
    def offset(self) -> int: ...
    @property
    def end_offset(self) -> int: ...

class Edit:
    @property
    def place(self) -> Place: ...
    @property
    def replacement(self) -> str: ...

class Fix:
    @property
    def title(self) -> str: ...
    @property
    def edits(self) -> list[Edit]: ...
    @property
    def certain(self) -> bool: ...  # no other repair is plausible

class Label:
    @property
    def place(self) -> Place: ...
    @property
    def text(self) -> str: ...

class Diagnostic:
    @property
    def severity(self) -> Literal["note", "warning", "error"]: ...
    @property
    def code(self) -> str: ...
    @property
    def message(self) -> str: ...
    @property
    def place(self) -> Optional[Place]: ...
    @property
    def label(self) -> str: ...  # text at `place`; may be empty
    @property
    def labels(self) -> list[Label]: ...  # further places
    @property
    def notes(self) -> list[str]: ...
    @property
    def help(self) -> list[str]: ...
    @property
    def fixes(self) -> list[Fix]: ...

class Constant:
    @property
    def name(self) -> str: ...
    @property
    def is_parameter(self) -> bool: ...  # a `#param`
    @property
    def value(self) -> Optional[float]: ...  # None: random
    @property
    def bounds(self) -> Optional[tuple[float, float]]: ...  # of a `#param`

class PredictedSize:  # bounds of the number of modules of a generation
    @property
    def low(self) -> float: ...
    @property
    def high(self) -> float: ...
    @property
    def low_segments(self) -> float: ...  # of the number of segments
    @property
    def high_segments(self) -> float: ...
    @property
    def max_bytes(self) -> int: ...  # of a word of `high` modules

class ModuleKind:
    @property
    def name(self) -> str: ...
    @property
    def stored_parameters(self) -> int: ...  # of each module, in Word.parameters
    @property
    def constants(self) -> list[float]: ...  # parameters of each module, if none are stored

class Word:
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[tuple[str, tuple[float, ...]]]: ...
    @property
    def generation(self) -> int: ...
    @property
    def seed(self) -> int: ...
    @property
    def kinds(self) -> list[ModuleKind]: ...  # by code
    @property
    def codes(self) -> NDArray[np.unsignedinteger[Any]]: ...  # one for each module
    @property
    def parameters(self) -> NDArray[np.float32]: ...  # the stored ones of all modules, in order

class PlantSize:
    @property
    def low(self) -> tuple[float, float, float]: ...  # bounds, without radii
    @property
    def high(self) -> tuple[float, float, float]: ...
    @property
    def height(self) -> float: ...
    @property
    def crown_width(self) -> float: ...  # twice the largest horizontal distance from the start
    @property
    def length(self) -> float: ...  # sum over all segments
    @property
    def volume(self) -> float: ...
    @property
    def mass(self) -> float: ...
    @property
    def segments_by_order(self) -> list[int]: ...  # numbers of segments within 0, 1, ... brackets

class Mesh:
    @property
    def positions(self) -> NDArray[np.float32]: ...
    @property
    def normals(self) -> NDArray[np.float32]: ...
    @property
    def texture_coordinates(self) -> NDArray[np.float32]: ...
    @property
    def tangents(self) -> NDArray[np.float32]: ...
    @property
    def colours(self) -> NDArray[np.uint32]: ...  # of vertices: palette index, or 0x1RRGGBB in sRGB
    @property
    def indices(self) -> NDArray[np.uint32]: ...
    @property
    def parts(self) -> list[tuple[int, int, int]]: ...  # material, first index, index count
    @property
    def materials(self) -> list[dict[str, Any]]: ...

class Plant:
    @property
    def modules(self) -> int: ...  # number of modules of the word
    @property
    def generations(self) -> int: ...
    @property
    def seed(self) -> int: ...
    @property
    def files(self) -> list[str]: ...  # meshes and pictures of `#object`, as written there
    @property
    def segments(self) -> NDArray[np.void]: ...
    @property
    def objects(self) -> NDArray[np.void]: ...
    @property
    def polygons(self) -> NDArray[np.void]: ...
    @property
    def corners(self) -> NDArray[np.float32]: ...  # of all polygons
    def measure(self) -> PlantSize: ...
    def mesh(
        self,
        method: str = "default",
        sides: int = 0,
        deviation: float = 0.0,
        texture_coordinates: bool = True,
        tangents: bool = True,
        smooth_joints: bool = False,
        min_width: float = 0.0,
        **kwargs: Any,
    ) -> Mesh: ...
    def export(
        self,
        mesh: Mesh,
        format: str,
        name: str = "plant",
        compress: str = "none",
        up: str = "y",
        **kwargs: Any,
    ) -> bytes: ...
    def save(
        self,
        path: _Path,
        *,
        mesh: Optional[Mesh] = None,
        preset: Optional[str] = None,
        **options: Any,
    ) -> list[str]: ...
    def write(self, name: str, receive: _Receive, **options: Any) -> list[str]: ...
    def files_of(self, name: str, **options: Any) -> dict[str, bytes]: ...
    def svg(self) -> str: ...
    def png(self, width: int = 320, height: int = 400) -> bytes: ...

class Grammar:
    @property
    def name(self) -> str: ...
    @property
    def generations(self) -> Optional[int]: ...
    @property
    def seed(self) -> int: ...
    @property
    def constants(self) -> list[Constant]: ...
    @property
    def translation(self) -> str: ...  # as .lsys; empty: the grammar is .lsys
    @property
    def bytecode(self) -> bytes: ...  # of a .lsb file
    def predict(self, generations: int) -> list[PredictedSize]: ...
    def derive(
        self, generations: Optional[int] = None, seed: Optional[int] = None, **kwargs: Unpack[_CallOptions]
    ) -> Word: ...
    def grow(
        self,
        generations: Optional[int] = None,
        seed: Optional[int] = None,
        height: Optional[float] = None,
        stream: bool = False,
        **kwargs: Unpack[_CallOptions],
    ) -> Plant: ...

class Species:
    @property
    def name(self) -> str: ...
    @property
    def generations(self) -> list[int]: ...  # of each stage
    @property
    def heroes(self) -> int: ...  # plants derived in full, per stage
    @property
    def height(self) -> float: ...  # of `#set height`; 0: not set

class ForestCounts:
    @property
    def trees(self) -> int: ...
    @property
    def branches(self) -> int: ...
    @property
    def segments(self) -> int: ...
    @property
    def objects(self) -> int: ...
    @property
    def polygons(self) -> int: ...
    @property
    def max_branches(self) -> int: ...  # of one tree

class Instances:
    def __len__(self) -> int: ...
    @property
    def meshes(self) -> list[Mesh]: ...
    @property
    def array(self) -> NDArray[np.void]: ...  # of type INSTANCE, sorted by group
    @property
    def groups(self) -> NDArray[np.void]: ...  # of INSTANCE_GROUP: draw calls
    def read_matrices(self, to: NDArray[np.float32], first: int = 0) -> None: ...
    def matrices(self) -> NDArray[np.float32]: ...

class Forest:
    def __init__(
        self,
        scene: Union[_Path, Sequence[_Path]],
        *,
        defines: Optional[Mapping[str, float]] = None,
        settings: Optional[Mapping[str, _Setting]] = None,
        generations: Optional[int] = None,
        **options: Any,
    ) -> None: ...
    @staticmethod
    def from_places(
        grammars: Union[_Path, Sequence[_Path]],
        positions: ArrayLike,
        *,
        rotation: ArrayLike = 0.0,
        scale: ArrayLike = 1.0,
        key: Optional[ArrayLike] = None,
        species: ArrayLike = 0,
        age: ArrayLike = 0,
        defines: Optional[Mapping[str, float]] = None,
        settings: Optional[Mapping[str, _Setting]] = None,
        generations: Optional[int] = None,
        **options: Any,
    ) -> Forest: ...
    @property
    def key(self) -> int: ...
    @property
    def species(self) -> list[Species]: ...
    @property
    def trees(self) -> NDArray[np.void]: ...  # of TREE
    @property
    def instances(self) -> Instances: ...
    def count(self) -> ForestCounts: ...
    def make_instances(
        self,
        method: str = "default",
        sides: int = 0,
        deviation: float = 0.0,
        texture_coordinates: bool = True,
        tangents: bool = True,
        smooth_joints: bool = False,
        min_width: float = 0.0,
        **kwargs: Any,
    ) -> Instances: ...
    def ground(self, **kwargs: Any) -> Mesh: ...
    def save(
        self, path: _Path, *, preset: Optional[str] = None, **options: Any
    ) -> list[str]: ...
    def write(self, name: str, receive: _Receive, **options: Any) -> list[str]: ...
    def files_of(self, name: str, **options: Any) -> dict[str, bytes]: ...

def compile(
    path: Optional[_Path] = None,
    *,
    text: Optional[str] = None,
    name: str = "grammar.lsys",
    defines: Optional[Mapping[str, float]] = None,
    settings: Optional[Mapping[str, _Setting]] = None,
    generations: Optional[int] = None,
    dialect: str = "",
    system: str = "",
    bug_compatible: bool = False,
    **options: Any,
) -> Grammar: ...
def options(of: str) -> dict[str, tuple[str, str]]: ...
