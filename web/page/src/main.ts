// SPDX-License-Identifier: MIT
// The playground. The text of the grammar is the only state: sliders, the generation and the seed
// write into it, and everything shown is made from it.
import wasmUrl from 'lsys/lsys.wasm?url';
import {
  applyFix,
  type Diagnostic,
  type Files,
  type Fix,
  type Grammar,
  LsysError,
  type PlantFacts,
  type PlantOptions,
} from 'lsys';
import { type Change, Controls } from './controls.js';
import { formats, save } from './downloads.js';
import { Editor } from './editor.js';
import { Engine, Stopped } from './engine.js';
import { fillGallery, filesOf, grammarOf } from './gallery.js';
import { showMessages } from './messages.js';
import { linkOf, projectOf } from './share.js';
import { Stage } from './stage.js';
import start from './start.lsys?raw';

const find = <Element extends HTMLElement>(id: string) =>
  document.getElementById(id) as unknown as Element;

const kName = 'plant.lsys';
const kDraft = 'lsc-playground-draft'; // key of the draft in localStorage
const kTypingPause = 250; // ms
const kPatience = 2000; // ms after which a newer text ends the call that runs

const view = find<HTMLCanvasElement>('view');
const generations = find<HTMLInputElement>('generations');
const generationText = find<HTMLOutputElement>('generation-text');
const messages = find('messages');
const word = find<HTMLDetailsElement>('word');
const play = find<HTMLButtonElement>('play');

/** The library as a compiled module. */
async function compile(): Promise<WebAssembly.Module> {
  const response = await fetch(wasmUrl);
  if (!response.ok) throw new Error(`the library cannot be read (${response.status})`);
  // Plain servers may send another type than that of WebAssembly, which streaming refuses.
  return response.headers.get('Content-Type')?.startsWith('application/wasm')
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}
const module = compile();

const engine = new Engine(module);
const editor = new Editor(find('editor'), { changed: onTyped, draw: () => refresh(), format });
const controls = new Controls(find('values'), (change) => changeValues(change));
let stage: Stage | null = null;
try {
  stage = new Stage(view);
} catch {
  view.hidden = true;
  find('facts').textContent = 'This browser shows no 3D graphics: WebGL 2 is missing.';
}

const titleInput = find<HTMLInputElement>('title');
let title = '';
let sample = ''; // id of the sample whose files the grammar uses; empty: none
let files: Files = {};
let grammar: Grammar | null = null;
let mode: 'plant' | 'forest' = 'plant';
let isNew = true; // the next plant is fitted into the view
let isStopped = false; // the author has pressed Stop; until the next change
let wanted = 0; // number of the newest text: calls of refresh() so far
let shown = 0; // number of the text shown last
let running = false; // run() is in progress
let playing = false; // a growth is played

function options(): PlantOptions {
  return { name: kName, files };
}

// --- from text to plant

/** Stores the text after a change by the author, who finds it again at the next visit. */
function keep(): void {
  history.replaceState(null, '', location.pathname + location.search); // drops an outdated link
  try {
    localStorage.setItem(kDraft, JSON.stringify({ text: editor.text, title, sample }));
  } catch {
    // Without storage there is no draft.
  }
}

let typing = 0; // timer of the pause after typing
function onTyped(): void {
  endGrowth();
  keep();
  clearTimeout(typing);
  typing = window.setTimeout(() => refresh(), kTypingPause);
}

/** Shows the plant of the text; a later text replaces an earlier one. */
function refresh(): void {
  ++wanted;
  isStopped = false;
  if (running && engine.busyFor > kPatience) engine.stop();
  void run();
}

/** Shows the newest text, and again until no newer one waits. */
async function run(): Promise<void> {
  if (running) return;
  running = true;
  while (shown !== wanted && !isStopped) {
    const number = wanted;
    try {
      await show(editor.text, () => number === wanted);
      shown = number;
      // Tells tests that a plant of this text is on the screen.
      requestAnimationFrame(() => (document.body.dataset.drawn = String(number)));
    } catch (error) {
      if (error instanceof Stopped) continue; // by a newer text, or by the author
      shown = number;
      if (error instanceof LsysError) say(error.diagnostics);
      else say([failure(String(error))]);
    }
  }
  running = false;
}

/** Shows messages, values and plant of `text`. Draws no plant if `isCurrent()` is false by then. */
async function show(text: string, isCurrent: () => boolean): Promise<void> {
  grammar = await engine.call('compile', text, options());
  say(grammar.diagnostics);
  // The seed has a control if the grammar has ranges, probabilities or a `#set seed`.
  const isRandom = /[{~]|#set\s+seed/.test(text.replace(/#(param|define)[^;]*;|\/\/.*/g, ''));
  controls.show(grammar, text, isRandom);
  showGenerations(grammar.generations ?? 0);
  if (!isCurrent()) return;
  if (mode === 'forest') return showForest(text);
  const mesh = await engine.call('mesh', text, options());
  say([...mesh.diagnostics]);
  stage?.showPlant(mesh, isNew);
  isNew = false;
  describe(mesh.plant, mesh.indices.length / 3);
  if (word.open) await showWord(text);
}

/** Shows 1,000 plants on a square whose side suits their width. */
async function showForest(text: string): Promise<void> {
  const one = await engine.call('skeleton', text, options());
  const [lowX, , lowZ] = one.plant.low;
  const [highX, , highZ] = one.plant.high;
  const width = Math.max(highX - lowX, highZ - lowZ, one.plant.height * 0.4) || 1;
  const side = Number((width * Math.sqrt(1000) * 0.85).toPrecision(4));
  const eye = [0.6 * side, 0.13 * side, 1.12 * side].map((each) => each.toPrecision(4));
  const { files: written } = await engine.call('forest', text, 'forest.glb', {
    ...options(),
    scene: { count: 1000, size: side, heroes: 5 },
    file: { instances: 'lods', viewpoint: eye.join(',') },
  });
  await stage?.showForest(written[0]!.bytes);
  isNew = false;
  view.ariaLabel = `A forest of 1,000 plants, about ${lengthOf(one.plant.height)} high`;
  find('facts').textContent = '1,000 plants';
}

function lengthOf(metres: number): string {
  if (metres >= 1) return `${Number(metres.toPrecision(3))} m`;
  return metres >= 0.01 ? `${Number((metres * 100).toPrecision(3))} cm` : `${metres.toPrecision(2)} m`;
}

function describe(plant: PlantFacts, triangles: number): void {
  const count = (value: number, name: string) =>
    `${value.toLocaleString('en')} ${name}${value === 1 ? '' : 's'}`;
  const parts = [
    count(plant.modules, 'letter'),
    count(plant.segments, 'segment'),
    ...(plant.objects > 0 ? [count(plant.objects, 'object')] : []),
    count(triangles, 'triangle'),
    `${lengthOf(plant.height)} high`,
  ];
  find('facts').textContent = parts.join(' · ');
  view.ariaLabel = `Plant of generation ${plant.generations}: ${parts.join(', ')}`;
}

async function showWord(text: string): Promise<void> {
  const kBytes = 20_000;
  const derived = await engine.call('derive', text, { ...options(), maxBytes: kBytes });
  find('word-text').textContent = derived.isWhole ? derived.text : `${derived.text} …`;
}
word.addEventListener('toggle', () => {
  if (word.open) refresh();
});

// --- messages and fixes

function failure(message: string): Diagnostic {
  const none = { code: '', place: null, label: '', labels: [], notes: [], help: [], fixes: [] };
  return { severity: 'error', message, ...none };
}

/** Shows messages below and in the editor. */
function say(diagnostics: Diagnostic[]): void {
  const apply = (fix: Fix) => {
    editor.setText(applyFix(editor.text, fix, kName));
    keep();
    refresh();
  };
  editor.mark(diagnostics, kName, apply);
  showMessages(messages, diagnostics, { apply, goTo: (place) => editor.goTo(place) });
}

async function format(): Promise<void> {
  await attempt(async () => {
    editor.setText(await engine.call('format', editor.text, options()));
    keep();
    refresh();
  });
}

/** Runs an action of the author; its failure is a message. */
async function attempt(action: () => Promise<void>): Promise<void> {
  try {
    await action();
  } catch (error) {
    if (error instanceof Stopped) return;
    if (error instanceof LsysError) say(error.diagnostics);
    else toast(String(error instanceof Error ? error.message : error));
  }
}

// --- values: sliders, generation and seed write into the text

let change: PlantOptions = {}; // values that are not yet in the text
let changing = false; // a call that writes values into the text is running
async function changeValues(next: Change & { generations?: number }): Promise<void> {
  endGrowth();
  change = {
    ...change,
    ...next,
    definitions: { ...change.definitions, ...next.definitions },
    settings: { ...change.settings, ...next.settings },
  };
  if (changing) return; // the last values are written when the call ends
  changing = true;
  await attempt(async () => {
    while (Object.keys(change).length > 0) {
      const values = change;
      change = {};
      const before = editor.text;
      const after = await engine.call('edit', before, { ...options(), ...values });
      if (editor.text === before) editor.setText(after);
      keep();
      refresh();
    }
  });
  change = {};
  changing = false;
}

function showGenerations(last: number): void {
  const max = Math.max(last + 3, Math.ceil(last * 1.25));
  if (Number(generations.max) < last || Number(generations.max) > 2 * max + 6 || isNew)
    generations.max = String(max);
  if (document.activeElement !== generations) generations.value = String(last);
  generationText.value = String(last);
  find('word-generation').textContent = String(last);
}
generations.addEventListener('input', () => {
  generationText.value = generations.value;
  void changeValues({ generations: generations.valueAsNumber });
});

// --- growth

play.addEventListener('click', () => (playing ? endGrowth(true) : void attempt(grow)));

/** Plays the growth of the plant from the axiom to the last generation. */
async function grow(): Promise<void> {
  const last = grammar?.generations ?? 0;
  if (last === 0 || !stage) return toast('A growth needs at least one generation.');
  if (mode === 'forest') setMode('plant');
  setPlaying(true);
  try {
    await engine.call('beginGrowth', editor.text, options());
    const seconds = Math.min(Math.max(last * 0.6, 3), 12);
    // Max part of the growth per frame: on slow machines the growth takes longer, but does not jump.
    const kLongestStep = 1 / 30;
    let before = performance.now();
    for (let part = 0; playing && part < 1; ) {
      const now = performance.now();
      part = Math.min(part + Math.min((now - before) / 1000 / seconds, kLongestStep), 1);
      before = now;
      const mesh = await engine.call('growthAt', part * last);
      if (!playing) break;
      stage.showPlant(mesh, false);
      generations.value = String(Math.round(part * last));
      generationText.value = String(Math.floor(part * last));
      await new Promise(requestAnimationFrame);
    }
  } finally {
    if (playing) setPlaying(false);
    generations.value = generationText.value = String(last);
  }
}

function setPlaying(value: boolean): void {
  playing = value;
  play.ariaLabel = value ? 'Stop growth' : 'Play growth';
  find('play-icon').setAttribute('d', value ? 'M6 5h4v14H6zm8 0h4v14h-4z' : 'M7 4.5v15l12.5-7.5z');
}

function endGrowth(showLast = false): void {
  if (!playing) return;
  setPlaying(false);
  if (showLast) refresh();
}

// --- work that takes long

engine.onProgress = ({ generation, generations: all, modules }) => {
  progress = `Generation ${generation} of ${all}, ${modules.toLocaleString('en')} letters`;
};
let progress = '';
setInterval(() => {
  const isBusy = engine.busyFor > (playing ? 2000 : 500);
  if (!isBusy) progress = '';
  find('busy').hidden = !isBusy;
  const text = progress || 'Drawing';
  if (isBusy && find('busy-text').textContent !== text) find('busy-text').textContent = text;
}, 200);
find('stop').addEventListener('click', () => {
  endGrowth();
  isStopped = true;
  shown = wanted;
  engine.stop();
  say([
    {
      ...failure('stopped; the last plant stays'),
      severity: 'note',
      help: ['change the grammar, or press Ctrl+Enter to draw it again'],
    },
  ]);
});

// --- plant or forest

function setMode(next: 'plant' | 'forest'): void {
  mode = next;
  isNew = true;
  find('show-plant').ariaPressed = String(next === 'plant');
  find('show-forest').ariaPressed = String(next === 'forest');
}
for (const each of ['plant', 'forest'] as const)
  find(`show-${each}`).addEventListener('click', () => {
    endGrowth();
    setMode(each);
    refresh();
  });
find('frame').addEventListener('click', () => stage?.fit());

// --- gallery, links, downloads, help

titleInput.addEventListener('input', () => {
  title = titleInput.value;
  keep();
});

async function open(text: string, newTitle: string, newSample: string): Promise<void> {
  endGrowth();
  title = newTitle;
  sample = newSample;
  files = newSample ? await filesOf(newSample) : {};
  titleInput.value = title;
  isNew = true;
  editor.setText(text, true);
  refresh();
}

function dialog(id: string): HTMLDialogElement {
  const found = find<HTMLDialogElement>(id);
  found.querySelector('.close')!.addEventListener('click', () => found.close());
  found.addEventListener('click', (event) => {
    if (event.target === found) found.close(); // a click outside
  });
  return found;
}
const gallery = dialog('gallery');
find('open-gallery').addEventListener('click', () => {
  gallery.showModal();
  void attempt(() =>
    fillGallery(find('gallery-items'), (chosen) => {
      gallery.close();
      void attempt(async () => {
        await open(await grammarOf(chosen), chosen.title, chosen.id);
        keep();
      });
    }),
  );
});
const help = dialog('help');
find('open-help').addEventListener('click', () => help.showModal());

find('share').addEventListener('click', async () => {
  history.replaceState(null, '', `#${linkOf({ text: editor.text, title, sample })}`);
  try {
    await navigator.clipboard.writeText(location.href);
    toast('Link copied. It holds the whole grammar.');
  } catch {
    toast('The link is in the address bar. It holds the whole grammar.');
  }
});

const downloads = find('downloads');
const download = find<HTMLButtonElement>('download');
function toggleDownloads(isOpen: boolean): void {
  downloads.hidden = !isOpen;
  download.ariaExpanded = String(isOpen);
  if (isOpen) downloads.querySelector('button')?.focus();
}
for (const each of formats) {
  const button = document.createElement('button');
  button.type = 'button';
  button.role = 'menuitem';
  button.dataset.format = each.extension;
  const about = document.createElement('small');
  about.textContent = each.about;
  button.append(each.extension.toUpperCase(), about);
  button.addEventListener('click', () => {
    toggleDownloads(false);
    download.focus();
    const name = (title || 'plant').toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '');
    void attempt(async () => {
      const context = { engine, stage: stage!, text: editor.text, options: options(), name };
      save(await each.make(context));
    });
  });
  downloads.append(button);
}
download.addEventListener('click', () => toggleDownloads(downloads.hidden));
downloads.addEventListener('keydown', (event) => {
  const items = [...downloads.querySelectorAll('button')];
  const at = items.indexOf(document.activeElement as HTMLButtonElement);
  const step = event.key === 'ArrowDown' ? 1 : event.key === 'ArrowUp' ? -1 : 0;
  if (step !== 0) {
    event.preventDefault();
    items.at((at + step) % items.length)!.focus();
  } else if (event.key === 'Escape') {
    toggleDownloads(false);
    download.focus();
  }
});
document.addEventListener('pointerdown', (event) => {
  if (!downloads.hidden && !download.parentElement!.contains(event.target as Node))
    toggleDownloads(false);
});

let toasting = 0; // timer that hides the toast
function toast(text: string): void {
  find('toast').textContent = text;
  clearTimeout(toasting);
  toasting = window.setTimeout(() => (find('toast').textContent = ''), 4000);
}

// --- the first plant

/** The grammar of the link, else the draft, else the tree of start.lsys. */
function firstProject(): { text: string; title: string; sample: string } {
  const shared = projectOf(location.hash);
  if (shared) return shared;
  if (location.hash.length > 1) toast('This link is damaged; here is a tree.');
  try {
    const draft = JSON.parse(localStorage.getItem(kDraft) ?? '');
    if (typeof draft.text === 'string' && draft.text.trim()) return draft;
  } catch {
    // No draft is stored.
  }
  return { text: start, title: 'A tree of three rules', sample: '' };
}
async function openFirst(): Promise<void> {
  const first = firstProject();
  await attempt(() => open(first.text, first.title, first.sample));
}
addEventListener('hashchange', () => void openFirst());
document.querySelector('.skip')!.addEventListener('click', (event) => {
  event.preventDefault();
  editor.focus();
});
void openFirst();

if ('serviceWorker' in navigator && import.meta.env.PROD)
  void navigator.serviceWorker.register('./sw.js').catch(() => undefined);
