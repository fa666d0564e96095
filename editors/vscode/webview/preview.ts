// SPDX-License-Identifier: MIT
// The page of the preview: the plant, with generation, seed and parameters.

import type { FromPage, PlantInfo, PreviewOptions, ToPage } from '../src/messages';
import type { Parameter } from '../src/protocol';
import { PlantView } from './plant_view';
import css from './preview.css';

declare function acquireVsCodeApi(): { postMessage(message: FromPage): void };

const api = acquireVsCodeApi();

function element<K extends keyof HTMLElementTagNameMap>(
  name: K,
  parent: HTMLElement,
  properties: Partial<HTMLElementTagNameMap[K]> = {},
): HTMLElementTagNameMap[K] {
  const child = document.createElement(name);
  Object.assign(child, properties);
  parent.append(child);
  return child;
}

// The Content-Security-Policy applies when an element is added, so its nonce is set before that.
const { nonce } = document.querySelector('script')!;
element('style', document.head, { nonce, textContent: css });

const canvas = element('canvas', document.body, { tabIndex: 0 });
const panel = element('div', document.body, { className: 'panel' });
const status = element('div', document.body, { className: 'status' });
const view = new PlantView(canvas);
view.onPick = (source, event) => api.postMessage({ type: 'pick', source, exact: event.altKey });

let options: PreviewOptions = { definitions: {} };

function send(): void {
  api.postMessage({ type: 'options', options });
}

/** A row with a number field and, if the value has a range, a slider. */
class NumberRow {
  private readonly name: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly number: HTMLInputElement;

  constructor(
    label: string,
    private readonly change: (value: number) => void,
    reset: () => void,
  ) {
    const block = element('label', panel);
    this.name = element('div', block, { className: 'name', textContent: label });
    const row = element('div', block, { className: 'row' });
    this.slider = element('input', row, { type: 'range' });
    this.number = element('input', row, { type: 'number' });
    element('button', row, { textContent: '↺', title: 'Value of the grammar', onclick: reset });
    for (const input of [this.slider, this.number]) {
      input.addEventListener('input', () => {
        if (Number.isFinite(input.valueAsNumber)) {
          (input === this.slider ? this.number : this.slider).value = input.value;
          this.change(input.valueAsNumber);
        }
      });
    }
  }

  /** limitsNumber: whether `max` limits the number, too, and not only the slider. */
  show(
    value: number | null,
    min: number | undefined,
    max: number | undefined,
    step: number | 'any',
    isChanged: boolean,
    title: string,
    limitsNumber = true,
  ): void {
    const hasRange = min !== undefined && max !== undefined && max > min;
    this.slider.hidden = !hasRange;
    for (const input of [this.slider, this.number]) {
      input.min = min === undefined ? '' : String(min);
      input.max = max === undefined ? '' : String(max);
      input.step = String(step);
      if (document.activeElement !== input) {
        input.value = value === null ? '' : String(value);
      }
    }
    if (!limitsNumber) {
      this.number.max = '';
    }
    this.number.placeholder = value === null ? 'random' : '';
    this.name.className = isChanged ? 'name changed' : 'name';
    this.name.title = title;
  }
}

const buttons = element('div', panel, { className: 'row' });
element('button', buttons, { textContent: 'Fit', title: 'Show the whole plant', onclick: () => view.fit() });
element('button', buttons, {
  textContent: 'Next seed',
  onclick: () => {
    options = { ...options, seed: shownSeed + 1 };
    send();
  },
});
element('button', buttons, {
  textContent: 'Reset',
  title: 'All values of the grammar',
  onclick: () => {
    options = { definitions: {} };
    send();
  },
});

let shownSeed = 0;
let lastInfo: PlantInfo | undefined;
let lastGeneration: number | null = null;
const generations = new NumberRow(
  'Generations',
  (value) => {
    options = { ...options, generations: Math.max(0, Math.round(value)) };
    send();
  },
  () => {
    const { generations: _, ...others } = options;
    options = others;
    send();
  },
);
const seed = new NumberRow(
  'Seed',
  (value) => {
    options = { ...options, seed: Math.max(0, Math.round(value)) };
    send();
  },
  () => {
    const { seed: _, ...others } = options;
    options = others;
    send();
  },
);
/** The rows of the parameters, by name. */
const rows = new Map<string, NumberRow>();

function stepOf(parameter: Parameter): number | 'any' {
  const { minimum, maximum } = parameter;
  if (minimum === undefined || maximum === undefined) {
    return 'any';
  }
  return Number(((maximum - minimum) / 200).toPrecision(1));
}

function showParameters(parameters: Parameter[]): void {
  const names = parameters.map((parameter) => parameter.name);
  if (names.join(' ') !== [...rows.keys()].join(' ')) {
    panel.querySelectorAll('label').forEach((label, number) => number >= 2 && label.remove());
    rows.clear();
    for (const name of names) {
      rows.set(
        name,
        new NumberRow(
          name,
          (value) => {
            options = { ...options, definitions: { ...options.definitions, [name]: value } };
            send();
          },
          () => {
            const { [name]: _, ...others } = options.definitions;
            options = { ...options, definitions: others };
            send();
          },
        ),
      );
    }
  }
  for (const parameter of parameters) {
    rows
      .get(parameter.name)
      ?.show(
        parameter.value,
        parameter.minimum,
        parameter.maximum,
        stepOf(parameter),
        parameter.name in options.definitions,
        parameter.comment,
      );
  }
}

function showValues(message: Extract<ToPage, { type: 'plant' | 'problem' }>): void {
  // Shows the options of the page, not those of the message: the page may have sent newer ones,
  // whose answer follows. A message about a mistake does not change the values of the last plant.
  if (message.type === 'plant') {
    lastInfo = message.info;
    lastGeneration = message.lastGeneration;
  }
  const shown = options.generations ?? lastInfo?.generations ?? 0;
  generations.show(
    shown,
    0,
    Math.max(lastGeneration ?? 0, shown, 1),
    1,
    options.generations !== undefined,
    lastGeneration === null ? 'the grammar has no #n' : `#n = ${lastGeneration}`,
    false,
  );
  shownSeed = options.seed ?? lastInfo?.seed ?? 0;
  seed.show(shownSeed, 0, undefined, 1, options.seed !== undefined, 'seed of random numbers');
  if (message.parameters.length > 0 || message.type === 'plant') {
    showParameters(message.parameters);
  }
}

function describe(info: PlantInfo): string {
  const count = (value: number, noun: string): string =>
    `${value.toLocaleString('en')} ${noun}${value === 1 ? '' : 's'}`;
  const parts = [
    `generation ${info.generations}`,
    count(info.modules, 'module'),
    count(info.triangles, 'triangle') + (info.level > 0 ? ', drawn coarsely' : ''),
    `${Math.max(1, Math.round(info.seconds * 1000))} ms`,
  ];
  return parts.join(', ');
}

// Whether the page has received no plant or problem yet.
let isFirst = true;
async function receive(message: ToPage): Promise<void> {
  if (message.type === 'busy') {
    status.classList.add('busy');
  } else if (message.type === 'highlight') {
    view.highlight(message.sources);
  } else {
    if (isFirst) {
      options = message.options;
      isFirst = false;
    }
    showValues(message);
    status.classList.remove('busy');
    status.classList.toggle('problem', message.type === 'problem');
    if (message.type === 'problem') {
      status.textContent = message.message;
    } else {
      status.textContent = describe(message.info);
      await view.show(message.glb);
      document.body.dataset['shown'] = String(Number(document.body.dataset['shown'] ?? 0) + 1);
    }
  }
}

window.addEventListener('message', (event: MessageEvent<ToPage>) => {
  receive(event.data).catch((error: Error) =>
    api.postMessage({ type: 'failure', message: error.message }),
  );
});
window.addEventListener('keydown', (event) => {
  if (event.key === 'f' && !(event.target instanceof HTMLInputElement)) {
    view.fit();
  }
});
// For tests.
Object.assign(globalThis, { plantView: view });
api.postMessage({ type: 'ready' });
