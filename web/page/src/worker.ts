// SPDX-License-Identifier: MIT
// The worker that runs the library, so that the page reacts to input meanwhile. The first message
// contains the compiled module, each further message a call of Lsys.
import { Lsys, LsysError } from 'lsys';
import type { CallMessage, StartMessage, WorkerAnswer } from './engine.js';

let lsys: Lsys;

/** The buffers of typed arrays in a value, to transfer and not copy them. */
function buffersOf(value: unknown, found = new Set<ArrayBuffer>()): Set<ArrayBuffer> {
  if (ArrayBuffer.isView(value)) found.add(value.buffer as ArrayBuffer);
  else if (typeof value === 'object' && value !== null)
    for (const member of Object.values(value)) buffersOf(member, found);
  return found;
}

function post(answer: WorkerAnswer): void {
  postMessage(answer, { transfer: answer.kind === 'result' ? [...buffersOf(answer.value)] : [] });
}

onmessage = ({ data }: MessageEvent<StartMessage | CallMessage>) => {
  if (data.kind === 'start') {
    let last = 0;
    lsys = new Lsys(data.module, (progress) => {
      const now = performance.now();
      if (now - last < 100) return;
      last = now;
      post({ kind: 'progress', progress });
    });
    return;
  }
  try {
    const call = lsys[data.name] as (...values: unknown[]) => unknown;
    post({ kind: 'result', id: data.id, value: call.apply(lsys, data.values) });
  } catch (error) {
    const known = error instanceof LsysError;
    post({
      kind: 'failure',
      id: data.id,
      status: known ? error.status : 'failed',
      diagnostics: known ? error.diagnostics : [],
      message: String(error),
    });
  }
};
