// SPDX-License-Identifier: MIT
// lsys: plants from L-system grammars, by the libraries of lsc as WebAssembly. In browsers,
// workers and Node.js. `load()` returns an instance with synchronous functions; `derive()`,
// `skeleton()`, `mesh()`, `glb()` and `diagnostics()` load one instance on their first use.

import type {
  Diagnostic,
  FileOptions,
  Files,
  Fix,
  ForestOptions,
  Grammar,
  GrammarOptions,
  Mesh,
  MeshOptions,
  PlantFacts,
  PlantOptions,
  Progress,
  Skeleton,
  Word,
  WrittenFiles,
} from './types.js';
import { Instance, type RawAnswer } from './wasm.js';

export * from './types.js';

/** The reason of a failure; 'diagnosed': mistakes in the grammar. */
export type Status = 'diagnosed' | 'failed' | 'limit' | 'out-of-memory' | 'cancelled';

/** A call without a result: mistakes in the grammar, a limit, a lack of memory. */
export class LsysError extends Error {
  constructor(
    readonly status: Status,
    readonly diagnostics: Diagnostic[],
  ) {
    super(diagnostics.find((each) => each.severity === 'error')?.message ?? status);
    this.name = 'LsysError';
  }
}

const kName = 'plant.lsys'; // default of GrammarOptions.name

function bytesOf(content: string | Uint8Array): Uint8Array {
  return typeof content === 'string' ? new TextEncoder().encode(content) : content;
}

/** Options as pairs of name and value; the value of a flag is empty. */
function pairsOf(options: FileOptions | undefined): [string, string][] {
  return Object.entries(options ?? {}).map(([name, value]) => [
    name,
    value === true ? '' : String(value),
  ]);
}

const floats = (block: Uint8Array) => new Float32Array(block.buffer as ArrayBuffer);
const numbers = (block: Uint8Array) => new Uint32Array(block.buffer as ArrayBuffer);
const text = (block: Uint8Array) => new TextDecoder().decode(block);

function meshOf({ head, blocks }: RawAnswer): Mesh {
  const { mesh } = head;
  return {
    positions: floats(blocks[mesh.positions]!),
    normals: floats(blocks[mesh.normals]!),
    textureCoordinates: floats(blocks[mesh.textureCoordinates]!),
    indices: numbers(blocks[mesh.indices]!),
    parts: mesh.parts,
    materials: mesh.materials,
    pictures: mesh.pictures.map((picture: any) => ({
      ...picture,
      texels: blocks[picture.texels]!,
    })),
    plant: head.plant as PlantFacts,
    diagnostics: head.messages,
  };
}

/** An instance of the library; all calls are synchronous. */
export class Lsys {
  private instance: Instance | null = null;

  constructor(
    private readonly module: WebAssembly.Module,
    private readonly onProgress?: (progress: Progress) => void,
  ) {}

  /** The messages about a grammar with their fixes; also of a grammar without mistakes. */
  diagnostics(source: string | Uint8Array, options: GrammarOptions = {}): Diagnostic[] {
    return this.request({ op: 'compile', ...this.grammar(options) }, source, options, false).head
      .messages;
  }

  /** Compiles a grammar: its parameters, settings and messages. */
  compile(source: string | Uint8Array, options: GrammarOptions = {}): Grammar {
    const { head } = this.request({ op: 'compile', ...this.grammar(options) }, source, options);
    const { generations, seed, constants, settings, translation, messages } = head;
    return { generations, seed, constants, settings, translation, diagnostics: messages };
  }

  /** The derived word. `maxBytes` cuts its text. */
  derive(
    source: string | Uint8Array,
    options: PlantOptions & { maxBytes?: number } = {},
  ): Word {
    const request: any = { op: 'derive', ...this.plant(options) };
    if (options.maxBytes !== undefined) request.maxBytes = options.maxBytes;
    const { head, blocks } = this.request(request, source, options);
    const { isWhole, modules, generations, seed, messages } = head;
    return {
      text: text(blocks[head.text]!),
      isWhole,
      modules,
      generations,
      seed,
      diagnostics: messages,
    };
  }

  /** The drawing of the turtle: segments, objects and polygons. */
  skeleton(source: string | Uint8Array, options: PlantOptions = {}): Skeleton {
    const { head, blocks } = this.request(
      { op: 'skeleton', ...this.plant(options) },
      source,
      options,
    );
    const { segments, objects, polygons } = head.skeleton;
    return {
      segments: {
        count: segments.count,
        start: floats(blocks[segments.start]!),
        end: floats(blocks[segments.end]!),
        radii: floats(blocks[segments.radii]!),
        parent: numbers(blocks[segments.parent]!),
        order: numbers(blocks[segments.order]!),
        colour: numbers(blocks[segments.colour]!),
      },
      objects: {
        count: objects.count,
        position: floats(blocks[objects.position]!),
        frame: floats(blocks[objects.frame]!),
        size: floats(blocks[objects.size]!),
        kind: numbers(blocks[objects.kind]!),
        colour: numbers(blocks[objects.colour]!),
        kinds: objects.kinds,
      },
      polygons: {
        count: polygons.count,
        cornerCounts: numbers(blocks[polygons.cornerCounts]!),
        corners: floats(blocks[polygons.corners]!),
        colour: numbers(blocks[polygons.colour]!),
      },
      plant: head.plant,
      diagnostics: head.messages,
    };
  }

  /** The triangles of the plant. */
  mesh(source: string | Uint8Array, options: MeshOptions = {}): Mesh {
    const request: any = { op: 'mesh', ...this.plant(options) };
    if (options.mesh) request.mesh = options.mesh;
    return meshOf(this.request(request, source, options));
  }

  /** The plant as a GLB file. `file`: options of `lsc export`, `{ preset: 'web' }`. */
  glb(
    source: string | Uint8Array,
    options: PlantOptions & { file?: FileOptions } = {},
  ): Uint8Array {
    return this.write(source, 'plant.glb', options).files[0]!.bytes;
  }

  /**
   * The plant as the file `path` and the files beside it: obj, ply, off, stl, gltf, glb, svg, usda
   * and usdz.
   */
  write(
    source: string | Uint8Array,
    path: string,
    options: PlantOptions & { file?: FileOptions } = {},
  ): WrittenFiles {
    const { file, ...rest } = options;
    const request = { op: 'write-plant', ...this.plant(rest), path, options: pairsOf(file) };
    return this.files(this.request(request, source, options));
  }

  /** The compiled grammar as a .lsb file. */
  bytecode(source: string | Uint8Array, options: GrammarOptions = {}): Uint8Array {
    const { head, blocks } = this.request(
      { op: 'bytecode', ...this.grammar(options) },
      source,
      options,
    );
    return blocks[head.bytes]!;
  }

  /** A forest of the grammar as the file `path`: glb, gltf, usda, or obj and others baked. */
  forest(
    source: string | Uint8Array,
    path: string,
    { scene, file, ...options }: ForestOptions = {},
  ): WrittenFiles {
    const request = {
      op: 'write-forest',
      ...this.grammar(options),
      names: [options.name ?? kName],
      path,
      scene: pairsOf(scene),
      options: pairsOf(file),
    };
    return this.files(this.request(request, source, options));
  }

  /** The text with new values in its statements; all other characters stay. */
  edit(source: string, options: PlantOptions): string {
    const { head, blocks } = this.request({ op: 'edit', ...this.plant(options) }, source, options);
    return text(blocks[head.text]!);
  }

  /** The text in the common layout, as by `lsc fmt`. */
  format(source: string, options: GrammarOptions = {}): string {
    const request = { op: 'format', ...this.grammar(options) };
    const { head, blocks } = this.request(request, source, options);
    return text(blocks[head.text]!);
  }

  /** Starts a growth for `growthAt()`. Returns the last generation. */
  beginGrowth(source: string | Uint8Array, options: PlantOptions = {}): number {
    return this.request({ op: 'begin-growth', ...this.plant(options) }, source, options).head
      .generations;
  }

  /** The plant of beginGrowth() at `time`, between two generations: 2.5. */
  growthAt(time: number, mesh?: MeshOptions['mesh']): Mesh {
    const request: any = { op: 'pose-growth', time };
    if (mesh) request.mesh = mesh;
    return meshOf(this.send(request, []));
  }

  /** The members of a request that describe the grammar. */
  private grammar(options: GrammarOptions): Record<string, unknown> {
    const { name, dialect, system, definitions, settings, maxModules } = options;
    return { name: name ?? kName, dialect, system, definitions, settings, maxModules };
  }

  /** The members of a request that describe the plant. */
  private plant(options: PlantOptions): Record<string, unknown> {
    const { generations, seed, height } = options;
    return { ...this.grammar(options), generations, seed, height };
  }

  private files({ head, blocks }: RawAnswer): WrittenFiles {
    return {
      files: head.files.map((file: any) => ({ name: file.name, bytes: blocks[file.bytes]! })),
      diagnostics: head.messages,
    };
  }

  /** Sends a request with the grammar and its files. `throws`: a failure is an LsysError. */
  private request(
    request: Record<string, unknown>,
    source: string | Uint8Array,
    options: { name?: string; files?: Files },
    throws = true,
  ): RawAnswer {
    const all: Files = { ...options.files, [options.name ?? kName]: source };
    const contents = Object.values(all).map(bytesOf);
    const files = Object.keys(all).map((path, i) => ({ path, size: contents[i]!.length }));
    return this.send({ ...request, files }, contents, throws);
  }

  private send(request: object, contents: Uint8Array[], throws = true): RawAnswer {
    this.instance ??= new Instance(this.module, this.onProgress);
    let answer: RawAnswer;
    try {
      answer = this.instance.request(request, contents);
    } catch (error) {
      this.instance = null; // a module that has failed is in no known state
      if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError) {
        throw new LsysError('out-of-memory', [failure('there is not enough memory')]);
      }
      throw error;
    }
    if (throws && answer.head.status !== 'ok') {
      throw new LsysError(answer.head.status, answer.head.messages);
    }
    return answer;
  }
}

function failure(message: string): Diagnostic {
  return {
    severity: 'error',
    code: '',
    message,
    place: null,
    label: '',
    labels: [],
    notes: [],
    help: [],
    fixes: [],
  };
}

/** Offset in `source` of a place's line and column. */
export function offsetOf(source: string, line: number, column: number): number {
  let at = 0;
  for (let i = 1; i < line; ++i) {
    const end = source.indexOf('\n', at);
    if (end < 0) return source.length;
    at = end + 1;
  }
  return Math.min(at + column - 1, source.length);
}

/** `source` after a repair; edits of other files than `name` are left out. */
export function applyFix(source: string, fix: Fix, name: string = kName): string {
  const edits = fix.edits
    .filter((edit) => edit.place.file === name)
    .map(({ place, replacement }) => ({
      from: offsetOf(source, place.line, place.column),
      to: offsetOf(source, place.endLine, place.endColumn),
      replacement,
    }))
    .sort((a, b) => b.from - a.from);
  return edits.reduce(
    (result, { from, to, replacement }) =>
      result.slice(0, from) + replacement + result.slice(to),
    source,
  );
}

async function compileModule(url: URL): Promise<WebAssembly.Module> {
  if (url.protocol === 'file:') {
    const fileSystem = 'node:fs/promises'; // a variable, so that bundlers leave it out
    const { readFile } = await import(/* @vite-ignore */ fileSystem);
    return WebAssembly.compile(await readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status}`);
  return response.headers.get('Content-Type')?.startsWith('application/wasm')
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}

export interface LoadOptions {
  /** The module, or its address. Default: lsys.wasm beside this file. */
  wasm?: WebAssembly.Module | URL | string;
  /** Called while a word is derived. */
  onProgress?: (progress: Progress) => void;
}

/** Loads an instance of the library. */
export async function load({ wasm, onProgress }: LoadOptions = {}): Promise<Lsys> {
  const module =
    wasm instanceof WebAssembly.Module
      ? wasm
      : await compileModule(new URL(wasm ?? new URL('lsys.wasm', import.meta.url)));
  return new Lsys(module, onProgress);
}

let shared: Promise<Lsys> | null = null; // instance of the functions below; null: not loaded
const instance = () => (shared ??= load());

type Call<Name extends keyof Lsys> = Lsys[Name] extends (...values: infer Values) => infer Result
  ? (...values: Values) => Promise<Result>
  : never;

export const diagnostics: Call<'diagnostics'> = async (...values) =>
  (await instance()).diagnostics(...values);
export const derive: Call<'derive'> = async (...values) => (await instance()).derive(...values);
export const skeleton: Call<'skeleton'> = async (...values) =>
  (await instance()).skeleton(...values);
export const mesh: Call<'mesh'> = async (...values) => (await instance()).mesh(...values);
export const glb: Call<'glb'> = async (...values) => (await instance()).glb(...values);
