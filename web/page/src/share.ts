// SPDX-License-Identifier: MIT
// Links: the fragment of the address holds the whole grammar, compressed.
import { deflateSync, inflateSync, strFromU8, strToU8 } from 'fflate';

/** A grammar as the page shows it. */
export interface Project {
  text: string;
  title: string;
  /** The sample whose files (pictures, meshes) the grammar uses; empty: none. */
  sample: string;
}

const kMaxLink = 2_000_000; // characters

function toBase64(bytes: Uint8Array): string {
  let binary = '';
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

function fromBase64(text: string): Uint8Array {
  const binary = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
  return Uint8Array.from(binary, (character) => character.charCodeAt(0));
}

/** The fragment of a link to `project`, without `#`. */
export function linkOf(project: Project): string {
  const packed = deflateSync(strToU8(JSON.stringify(project)), { level: 9 });
  return `g=${toBase64(packed)}`;
}

/** The grammar of a fragment; null if it has none, or if it is damaged. */
export function projectOf(fragment: string): Project | null {
  const match = /^#?g=([\w-]+)$/.exec(fragment);
  if (!match || match[1]!.length > kMaxLink) return null;
  try {
    const project = JSON.parse(strFromU8(inflateSync(fromBase64(match[1]!))));
    const { text, title, sample } = project;
    return typeof text === 'string' && typeof title === 'string' && typeof sample === 'string'
      ? { text, title, sample }
      : null;
  } catch {
    return null;
  }
}
