// SPDX-License-Identifier: MIT
// The gallery: samples with pictures. gallery/list.json is made by gallery.mjs of the build.
import type { Files } from 'lsys';

export interface Sample {
  id: string;
  title: string;
  about: string;
  group: string;
  /** Files beside the grammar that it names. */
  files: string[];
}

const kFolder = './gallery';
let list: Promise<Sample[]> | null = null;

async function get(path: string): Promise<Response> {
  const response = await fetch(path);
  if (!response.ok) throw new Error(`${path} cannot be read (${response.status})`);
  return response;
}

export function samples(): Promise<Sample[]> {
  list ??= get(`${kFolder}/list.json`).then((response) => response.json());
  list.catch(() => (list = null)); // another try may succeed
  return list;
}

export async function grammarOf(sample: Sample): Promise<string> {
  return (await get(`${kFolder}/${sample.id}/${sample.id}.lsys`)).text();
}

/** The files of a sample by path; none if `id` is no sample. */
export async function filesOf(id: string): Promise<Files> {
  const sample = id ? (await samples()).find((each) => each.id === id) : undefined;
  const files: Files = {};
  for (const path of sample?.files ?? []) {
    const response = await get(`${kFolder}/${sample!.id}/${path}`);
    files[path] = new Uint8Array(await response.arrayBuffer());
  }
  return files;
}

/** Fills the dialog with cards. */
export async function fillGallery(
  parent: HTMLElement,
  choose: (sample: Sample) => void,
): Promise<void> {
  if (parent.childElementCount > 0) return;
  const groups = new Map<string, HTMLElement>();
  for (const sample of await samples()) {
    let cards = groups.get(sample.group);
    if (!cards) {
      const title = document.createElement('h3');
      title.textContent = sample.group;
      cards = document.createElement('div');
      cards.className = 'cards';
      groups.set(sample.group, cards);
      parent.append(title, cards);
    }
    const card = document.createElement('button');
    card.type = 'button';
    const picture = document.createElement('img');
    picture.src = `${kFolder}/${sample.id}/picture.png`;
    picture.alt = '';
    picture.loading = 'lazy';
    const title = document.createElement('span');
    title.textContent = sample.title;
    const about = document.createElement('small');
    about.textContent = sample.about;
    card.append(picture, title, about);
    card.addEventListener('click', () => choose(sample));
    cards.append(card);
  }
}
