// SPDX-License-Identifier: MIT
// The explanations of messages: sections of grammar/explanations.md, which `lsc explain` prints.

/** A paragraph, or an example grammar with its heading. */
export interface Piece {
  text: string;
  /** "wrong" or "right" for examples; empty for paragraphs. */
  example: string;
}

let sections: Promise<Map<string, string>> | null = null;

async function read(): Promise<Map<string, string>> {
  const { default: text } = await import('../../../grammar/explanations.md?raw');
  return new Map(
    text
      .split(/^## /m)
      .slice(1)
      .map((section) => {
        const end = section.indexOf('\n');
        return [section.slice(0, end).trim(), section.slice(end + 1).trim()] as const;
      }),
  );
}

/** The explanation of a code; empty if there is none. */
export async function explain(code: string): Promise<Piece[]> {
  sections ??= read();
  const section = (await sections).get(code) ?? '';
  const pieces: Piece[] = [];
  for (const [index, part] of section.split('```').entries()) {
    if (index % 2 === 1) {
      const end = part.indexOf('\n');
      const example = /right/.test(part.slice(0, end)) ? 'right' : 'wrong';
      pieces.push({ text: part.slice(end + 1).trimEnd(), example });
      continue;
    }
    for (const paragraph of part.split(/\n\s*\n/)) {
      const text = paragraph.trim().replace(/\s*\n\s*/g, ' ');
      if (text) pieces.push({ text, example: '' });
    }
  }
  return pieces;
}
