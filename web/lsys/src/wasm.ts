// SPDX-License-Identifier: MIT
// An instance of lsys.wasm: passes requests to it and reads its answers.

import type { Progress } from './types.js';

const ENOSYS = 52;

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  lsys_reserve(size: number): number;
  lsys_answer(requestSize: number, size: number): number;
  lsys_release(): void;
  __indirect_function_table: WebAssembly.Table;
  stackSave(): number;
  stackRestore(at: number): void;
  setThrew(threw: number, value: number): void;
}

/** Thrown by longjmp(), which the readers and writers of PNG use. */
class LongJump {}

/** The head of an answer and its blocks, copied out of the module. */
export interface RawAnswer {
  head: any;
  blocks: Uint8Array[];
}

export class Instance {
  private readonly exports: Exports;

  constructor(module: WebAssembly.Module, onProgress?: (progress: Progress) => void) {
    let memory: WebAssembly.Memory | undefined;
    let upperHalf = 0; // of a result of 64 bits
    const view = () => new DataView(memory!.buffer);
    // Imports by name; the module calls them.
    const known: Record<string, (...values: any[]) => any> = {
      progress: (generation: number, generations: number, modules: number) =>
        onProgress?.({ generation, generations, modules }),
      fd_write: (_file: number, list: number, count: number, written: number) => {
        // The libraries print nothing; a failed check of the standard library does.
        let size = 0;
        let text = '';
        for (let i = 0; i < count; ++i) {
          const at = view().getUint32(list + 8 * i, true);
          const length = view().getUint32(list + 8 * i + 4, true);
          text += new TextDecoder().decode(new Uint8Array(memory!.buffer, at, length));
          size += length;
        }
        if (text.trim()) console.error(text);
        view().setUint32(written, size, true);
        return 0;
      },
      clock_time_get: (_clock: number, _precision: bigint, at: number) => {
        view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
        return 0;
      },
      environ_sizes_get: (count: number, size: number) => {
        view().setUint32(count, 0, true);
        view().setUint32(size, 0, true);
        return 0;
      },
      environ_get: () => 0,
      emscripten_notify_memory_growth: () => undefined,
      setTempRet0: (value: number) => (upperHalf = value),
      getTempRet0: () => upperHalf,
      _emscripten_throw_longjmp: () => {
        throw new LongJump();
      },
      proc_exit: (status: number) => {
        throw new WebAssembly.RuntimeError(`the module ended with status ${status}`);
      },
    };
    /** Calls a function of the module that may call longjmp(). */
    const invoke = (index: number, ...values: unknown[]) => {
      const { __indirect_function_table: table, stackSave, stackRestore, setThrew } = this.exports;
      const stack = stackSave();
      try {
        return table.get(index)(...values);
      } catch (error) {
        stackRestore(stack);
        if (!(error instanceof LongJump)) throw error;
        setThrew(1, 0);
        return 0;
      }
    };
    // There is no file system: calls of the system fail.
    const imports: WebAssembly.Imports = {};
    for (const item of WebAssembly.Module.imports(module)) {
      const missing = item.module === 'env' ? -ENOSYS : ENOSYS;
      const stub = item.name.startsWith('invoke_') ? invoke : () => missing;
      (imports[item.module] ??= {})[item.name] = known[item.name] ?? stub;
    }
    this.exports = new WebAssembly.Instance(module, imports).exports as unknown as Exports;
    memory = this.exports.memory;
    this.exports._initialize();
  }

  /** Throws WebAssembly.RuntimeError if the module has failed; it cannot be used afterwards. */
  request(request: object, files: Uint8Array[]): RawAnswer {
    const text = new TextEncoder().encode(JSON.stringify(request));
    const size = files.reduce((sum, file) => sum + file.length, text.length);
    let at = this.exports.lsys_reserve(size) >>> 0;
    if (at === 0) throw new WebAssembly.RuntimeError('not enough memory for the request');
    const input = new Uint8Array(this.exports.memory.buffer);
    for (const bytes of [text, ...files]) {
      input.set(bytes, at);
      at += bytes.length;
    }
    const pairs = this.exports.lsys_answer(text.length, size) >>> 0;
    if (pairs === 0) throw new WebAssembly.RuntimeError('not enough memory for the answer');
    const memory = this.exports.memory.buffer;
    const view = new DataView(memory);
    const block = (index: number) => {
      const from = view.getUint32(pairs + 8 * index, true);
      return new Uint8Array(memory.slice(from, from + view.getUint32(pairs + 8 * index + 4, true)));
    };
    const head = JSON.parse(new TextDecoder().decode(block(0)));
    const blocks = [];
    for (let i = 0; i < head.blocks; ++i) blocks.push(block(i + 1));
    this.exports.lsys_release();
    return { head, blocks };
  }
}
