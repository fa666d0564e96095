// SPDX-License-Identifier: MIT
// Sliders of the parameters, the seed and settings that the grammar states. A slider changes the
// text of the grammar.
import type { Grammar, PlantOptions } from 'lsys';

/** A value to write into the text. */
export type Change = Pick<PlantOptions, 'definitions' | 'settings'>;

/** A slider. */
interface Row {
  key: string;
  label: string;
  hint: string;
  value: number;
  min: number;
  max: number;
  isWhole: boolean;
  change(value: number): Change;
}

/** About 200 steps from end to end, of a round size. */
export function stepOf(min: number, max: number): number {
  const rough = (max - min) / 200;
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5].find((digit) => digit * power >= rough) ?? 10);
}

/** A value as it is shown, and written into the text. */
export function textOf(value: number): string {
  return String(Number(value.toPrecision(6)));
}

/** The sliders of parameters with bounds, and of numbers that a `#set` of the source states. */
function rowsOf(grammar: Grammar, source: string): Row[] {
  const rows: Row[] = [];
  for (const each of grammar.constants) {
    if (!each.isParameter || !(each.max > each.min)) continue;
    const [comment = ''] = each.text.split('\n');
    rows.push({
      key: each.name,
      label: each.name,
      hint: each.text.includes('\n') ? comment : '',
      value: each.value,
      min: each.min,
      max: each.max,
      isWhole: false,
      change: (value) => ({ definitions: { [each.name]: value } }),
    });
  }
  for (const each of grammar.settings) {
    const isNumber = each.kind === 'number' || each.kind === 'count';
    const isStated = new RegExp(`^\\s*#set\\s+${each.key}\\b`, 'm').test(source);
    if (!isNumber || !isStated || !(each.max > each.min)) continue;
    const value = each.numbers[0]!;
    rows.push({
      key: `set ${each.key}`,
      label: each.key,
      hint: each.accepts,
      value,
      min: Math.min(each.min, value),
      max: Math.max(each.max, value),
      isWhole: each.kind === 'count',
      change: (changed) => ({ settings: { [each.key]: textOf(changed) } }),
    });
  }
  return rows;
}

export class Controls {
  private shape = ''; // names and ranges of the sliders that are built, as JSON
  private inputs = new Map<string, HTMLInputElement>();
  private outputs = new Map<string, HTMLOutputElement>();
  private seed: HTMLInputElement | null = null;

  constructor(
    private readonly parent: HTMLElement,
    private readonly changed: (change: Change) => void,
  ) {}

  /** Shows the values of the grammar; keeps a slider that is being dragged. */
  show(grammar: Grammar, source: string, isRandom: boolean): void {
    const rows = rowsOf(grammar, source);
    const shape = JSON.stringify([isRandom, rows.map((row) => [row.key, row.min, row.max, row.hint])]);
    if (shape !== this.shape) this.build(rows, isRandom, shape);
    for (const row of rows) {
      const input = this.inputs.get(row.key)!;
      if (document.activeElement !== input || Math.abs(input.valueAsNumber - row.value) > 1e-4) {
        input.value = String(row.value);
        this.outputs.get(row.key)!.value = textOf(row.value);
      }
    }
    if (this.seed && document.activeElement !== this.seed) this.seed.value = String(grammar.seed);
  }

  private build(rows: Row[], isRandom: boolean, shape: string): void {
    this.shape = shape;
    this.inputs.clear();
    this.outputs.clear();
    this.seed = null;
    this.parent.replaceChildren();
    rows.forEach((row, index) => this.addSlider(row, `value-${index}`));
    if (isRandom) this.addSeed();
  }

  private addSlider(row: Row, id: string): void {
    const box = document.createElement('div');
    box.className = 'value';
    const label = document.createElement('label');
    label.htmlFor = id;
    label.append(row.label);
    if (row.hint) {
      const hint = document.createElement('small');
      hint.textContent = `  ${row.hint}`;
      label.append(hint);
      label.title = row.hint;
    }
    const output = document.createElement('output');
    output.htmlFor.add(id);
    const input = document.createElement('input');
    Object.assign(input, { id, type: 'range' });
    input.min = String(row.min);
    input.max = String(row.max);
    input.step = row.isWhole ? '1' : String(stepOf(row.min, row.max));
    input.addEventListener('input', () => {
      output.value = textOf(input.valueAsNumber);
      this.changed(row.change(Number(input.valueAsNumber.toPrecision(6))));
    });
    box.append(label, output, input);
    this.parent.append(box);
    this.inputs.set(row.key, input);
    this.outputs.set(row.key, output);
  }

  private addSeed(): void {
    const box = document.createElement('div');
    box.className = 'value';
    const label = document.createElement('label');
    label.htmlFor = 'seed';
    label.textContent = 'seed';
    const line = document.createElement('div');
    line.className = 'seed';
    const input = document.createElement('input');
    Object.assign(input, { id: 'seed', type: 'number', min: '0', step: '1' });
    const change = (value: number) => {
      if (!Number.isSafeInteger(value) || value < 0) return;
      input.value = String(value);
      this.changed({ settings: { seed: String(value) } });
    };
    input.addEventListener('change', () => change(input.valueAsNumber));
    const next = document.createElement('button');
    next.type = 'button';
    next.id = 'next-seed';
    next.textContent = 'Another plant';
    next.addEventListener('click', () => change((input.valueAsNumber || 0) + 1));
    line.append(input, next);
    box.append(label, line);
    this.parent.append(box);
    this.seed = input;
  }
}
