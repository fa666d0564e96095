// SPDX-License-Identifier: MIT
// The request `lsys/plant` of `lsc lsp`, as docs/editors.md describes it.

export interface Position {
  line: number;
  character: number;
}
export interface Range {
  start: Position;
  end: Position;
}

/** A place in a grammar that wrote modules of the word, which drew parts of the plant. */
export interface Source {
  /** The production that wrote the modules; null: the axiom. */
  production: string | null;
  uri?: string;
  /** The module in the successor or axiom. */
  range?: Range;
  /** The whole statement. */
  statement?: Range;
}

/** A constant of the grammar. */
export interface Parameter {
  name: string;
  /** The comment after its statement; may be empty. */
  comment: string;
  /** null: a random value. */
  value: number | null;
  minimum?: number;
  maximum?: number;
}

export interface Plant {
  /** A GLB file as Base64; empty if the plant draws nothing. */
  glb: string;
  modules: number;
  triangles: number;
  /** 0 is the finest mesh. */
  level: number;
  generations: number;
  seed: number;
  /** Time in which the server made the plant. */
  seconds: number;
  sources: Source[];
}

export interface PlantParams {
  textDocument: { uri: string };
  generations?: number;
  seed?: number;
  definitions?: Record<string, number>;
  maxModules?: number;
  maxTriangles?: number;
  maxSeconds?: number;
  textures?: boolean;
}

export interface PlantResult {
  version: number;
  parameters: Parameter[];
  /** The value of `#n`. */
  lastGeneration: number | null;
  /** null: no plant could be made; see `reason`. */
  plant: Plant | null;
  /** Mistakes in the grammar, or a limit. */
  reason?: 'grammar' | 'limit';
  message?: string;
}

export const plantMethod = 'lsys/plant';
/** Error codes of requests that have been replaced or cancelled. */
export const serverCancelled = -32802;
export const requestCancelled = -32800;
