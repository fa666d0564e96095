// SPDX-License-Identifier: MIT
// Engine: calls of Lsys in a worker, one after the other. stop() ends a call at once by ending its
// worker; the next call starts another one.
import { type Diagnostic, type Lsys, LsysError, type Progress, type Status } from 'lsys';

type Name = {
  [Key in keyof Lsys]: Lsys[Key] extends (...values: any[]) => any ? Key : never;
}[keyof Lsys];
type Values<Key extends Name> = Lsys[Key] extends (...values: infer Given) => any ? Given : never;
type Result<Key extends Name> = Lsys[Key] extends (...values: any[]) => infer Value ? Value : never;

export interface StartMessage {
  kind: 'start';
  module: WebAssembly.Module;
}
export interface CallMessage {
  kind: 'call';
  id: number;
  name: Name;
  values: unknown[];
}
export type WorkerAnswer =
  | { kind: 'progress'; progress: Progress }
  | { kind: 'result'; id: number; value: unknown }
  | { kind: 'failure'; id: number; status: Status; diagnostics: Diagnostic[]; message: string };

/** The reason of a call that stop() has ended. */
export class Stopped extends Error {}

interface Job {
  message: CallMessage;
  resolve(value: any): void;
  reject(reason: unknown): void;
}

export class Engine {
  onProgress: (progress: Progress) => void = () => undefined;
  private worker: Worker | null = null;
  private running: Job | null = null;
  private waiting: Job[] = [];
  private started = 0; // performance.now() when the running call began
  private count = 0; // number of calls so far; the id of the last one

  /** Starts a worker at once, so that it is ready for the first call. */
  constructor(private readonly module: Promise<WebAssembly.Module>) {
    module.then(
      (compiled) => (this.worker ??= this.start(compiled)),
      () => undefined, // the first call reports it
    );
  }

  /** Milliseconds since the running call began; 0: none runs. */
  get busyFor(): number {
    return this.running ? performance.now() - this.started : 0;
  }

  call<Key extends Name>(name: Key, ...values: Values<Key>): Promise<Result<Key>> {
    return new Promise((resolve, reject) => {
      const message: CallMessage = { kind: 'call', id: ++this.count, name, values };
      this.waiting.push({ message, resolve, reject });
      void this.next();
    });
  }

  /** Ends the running call and drops the waiting ones: they reject with Stopped. */
  stop(): void {
    this.worker?.terminate();
    this.worker = null;
    const all = [...(this.running ? [this.running] : []), ...this.waiting];
    this.running = null;
    this.waiting = [];
    for (const job of all) job.reject(new Stopped());
  }

  private async next(): Promise<void> {
    if (this.running) return;
    const job = this.waiting.shift();
    if (!job) return;
    this.running = job;
    this.started = performance.now();
    try {
      const module = await this.module;
      if (this.running !== job) return; // stopped meanwhile
      this.worker ??= this.start(module);
      this.worker.postMessage(job.message);
    } catch (error) {
      this.finish((each) => each.reject(error));
    }
  }

  private start(module: WebAssembly.Module): Worker {
    const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
    worker.onmessage = ({ data }: MessageEvent<WorkerAnswer>) => {
      if (worker !== this.worker) return;
      if (data.kind === 'progress') this.onProgress(data.progress);
      else if (data.id !== this.running?.message.id) return;
      else if (data.kind === 'result') this.finish((job) => job.resolve(data.value));
      else if (data.diagnostics.length > 0)
        this.finish((job) => job.reject(new LsysError(data.status, data.diagnostics)));
      else this.finish((job) => job.reject(new Error(data.message)));
    };
    worker.onerror = (event) => {
      this.worker = null;
      this.finish((job) => job.reject(new Error(event.message || 'the worker has failed')));
    };
    worker.postMessage({ kind: 'start', module } satisfies StartMessage);
    return worker;
  }

  private finish(settle: (job: Job) => void): void {
    const job = this.running;
    this.running = null;
    if (job) settle(job);
    void this.next();
  }
}
