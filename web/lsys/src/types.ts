// SPDX-License-Identifier: MIT
// The types of the values that functions of the package take and return.

/** A range of characters. Lines and columns count from 1; a column is a UTF-16 code unit. */
export interface Place {
  file: string;
  line: number;
  column: number;
  endLine: number;
  endColumn: number;
}

export interface Edit {
  place: Place;
  replacement: string;
}

/** A repair: edits that do not overlap, applied together. */
export interface Fix {
  title: string;
  /** Whether no other repair is plausible. */
  certain: boolean;
  edits: Edit[];
}

export interface Diagnostic {
  severity: 'note' | 'warning' | 'error';
  /** Stable name, `unknown-name`; empty for failures that are no mistake of the grammar. */
  code: string;
  message: string;
  place: Place | null;
  /** Text at the place; may be empty. */
  label: string;
  labels: { place: Place; text: string }[];
  notes: string[];
  help: string[];
  fixes: Fix[];
  /** The message with its lines of source, as `lsc` prints it. */
  text?: string;
}

/** Files that the grammar names: included grammars, meshes, pictures. Keys are paths. */
export type Files = Record<string, string | Uint8Array>;

export interface GrammarOptions {
  /** File name of the grammar; its extension selects the dialect. Default: `plant.lsys`. */
  name?: string;
  files?: Files;
  /** Name of the dialect, as for `lsc --dialect`; default: by the extension of `name`. */
  dialect?: string;
  /** The system in a file with several systems. */
  system?: string;
  /** Max number of modules of a word; default 2^32. */
  maxModules?: number;
  /** Values of `#define` and `#param` by name. */
  definitions?: Record<string, number>;
  /** Values of `#set` by key, in the syntax of the language: `{ angle: '22.5' }`. */
  settings?: Record<string, string>;
}

export interface PlantOptions extends GrammarOptions {
  /** Default: `#n` of the grammar. */
  generations?: number;
  /** Default: `#set seed` of the grammar, else 0. */
  seed?: number;
  /** Metres; the plant is scaled to this height. */
  height?: number;
}

export interface MeshOptions extends PlantOptions {
  mesh?: {
    method?: 'default' | 'tubes' | 'cylinders' | 'boxes' | 'solid';
    /** Max distance in metres of a ring of a tube from its circle; 0: the sides of the grammar. */
    deviation?: number;
    /** Sides of every cross-section; 0, the default: the sides of the grammar. */
    sides?: number;
    /** Whether stems bend along smooth curves through their joints. */
    smoothJoints?: boolean;
  };
}

/** The constant of a `#define` or `#param`. */
export interface Constant {
  name: string;
  /** Whether the statement is a `#param`, with a range from `min` to `max`. */
  isParameter: boolean;
  /** Whether the value is drawn for each seed; `value` has no meaning. */
  isRandom: boolean;
  value: number;
  min: number;
  max: number;
  /** The comment after its statement, its value and range, in lines. */
  text: string;
}

/** A `#set key value;` that has a control. */
export interface Setting {
  key: string;
  kind: 'number' | 'count' | 'vector' | 'word';
  /** The value: four numbers of a vector, else one. */
  numbers: number[];
  /** The values allowed, as a phrase: "an angle in degrees". */
  accepts: string;
  /** The value if `kind` is `word`. */
  word: string;
  words: string[]; // all values that `word` may have
  /** Range of a slider; none unless `max` is above `min`. */
  min: number;
  max: number;
}

export interface Grammar {
  /** `#n` of the grammar; null: not stated. */
  generations: number | null;
  seed: number;
  constants: Constant[];
  settings: Setting[];
  /** The .lsys text of a grammar in another dialect; else empty. */
  translation: string;
  diagnostics: Diagnostic[];
}

export interface Word {
  text: string;
  /** False if `maxBytes` has cut the text. */
  isWhole: boolean;
  /** Number of modules of the whole word. */
  modules: number;
  generations: number;
  seed: number;
  diagnostics: Diagnostic[];
}

export interface PlantFacts {
  /** Number of modules of the word. */
  modules: number;
  generations: number;
  seed: number;
  segments: number;
  objects: number;
  polygons: number;
  /** Metres. */
  height: number;
  /** Corners, m, of the box around axes of segments, positions of objects and polygons; without radii. */
  low: [number, number, number];
  high: [number, number, number];
}

/** Items of `n` numbers each are one after the other: `start` has x, y, z of each segment. */
export interface Skeleton {
  segments: {
    count: number;
    start: Float32Array;
    end: Float32Array;
    /** Metres, at the base and at the tip of each segment. */
    radii: Float32Array;
    /** Index of the segment before it on its path; 0xFFFFFFFF: none. */
    parent: Uint32Array;
    /** Number of open brackets: 0 is the trunk. */
    order: Uint32Array;
    /** Index in the palette, or 0x01000000 + RGB. */
    colour: Uint32Array;
  };
  objects: {
    count: number;
    position: Float32Array;
    /** Quaternions x, y, z, w; the object points along +Y. */
    frame: Float32Array;
    /** Scale factors. */
    size: Float32Array;
    /** Index in `kinds`. */
    kind: Uint32Array;
    colour: Uint32Array;
    kinds: string[];
  };
  polygons: {
    count: number;
    /** Number of corners of each polygon. */
    cornerCounts: Uint32Array;
    /** Corners of all polygons, x, y, z each. */
    corners: Float32Array;
    colour: Uint32Array;
  };
  plant: PlantFacts;
  diagnostics: Diagnostic[];
}

export interface Picture {
  /** Set for pictures that are the same in all plants: `bark`, `bark-normals`, `leaf`. */
  id: string | null;
  width: number;
  height: number;
  /** Rows from v = 0 on, red, green, blue (sRGB) and opacity. */
  texels: Uint8Array;
}

export interface Material {
  name: string;
  /** Linear red, green, blue, opacity, from 0 to 1; multiplies the picture. */
  colour: [number, number, number, number];
  roughness: number;
  translucency: number | null;
  twoSided: boolean;
  /** Texels below half opacity are discarded. */
  cutOut: boolean;
  /** Index in `Mesh.pictures` of the picture, and of the normal map; null: none. */
  picture: number | null;
  normals: number | null;
}

/** Triangles, counter-clockwise seen from outside; metres, +Y up. */
export interface Mesh {
  positions: Float32Array;
  normals: Float32Array;
  /** v goes down, as in glTF. */
  textureCoordinates: Float32Array;
  indices: Uint32Array;
  /** Triangles of one material: `count` items of `indices` from `first` on. */
  parts: { material: number; first: number; count: number }[];
  materials: Material[];
  pictures: Picture[];
  plant: PlantFacts;
  diagnostics: Diagnostic[];
}

export interface NamedFile {
  name: string;
  bytes: Uint8Array;
}

export interface WrittenFiles {
  files: NamedFile[];
  diagnostics: Diagnostic[];
}

/** Options of `lsc export` and `lsc forest` by name without dashes; `true` for flags. */
export type FileOptions = Record<string, string | number | true>;

export interface ForestOptions extends GrammarOptions {
  /** Options of the scene: `{ count: 1000, heroes: 5, placement: 'poisson' }`. */
  scene?: FileOptions;
  /** Options of the file. */
  file?: FileOptions;
}

export interface Progress {
  /** The generation that is being derived. */
  generation: number;
  /** Number of generations of the derivation. */
  generations: number;
  /** Number of modules written so far. */
  modules: number;
}
