// SPDX-License-Identifier: MIT
// Finds the sources, modules that drew parts of the plant, at a position in the grammar.

import type { Position, Range, Source } from './protocol';

function isBefore(a: Position, b: Position): boolean {
  return a.line < b.line || (a.line === b.line && a.character < b.character);
}

function holds(range: Range | undefined, position: Position): boolean {
  return range !== undefined && !isBefore(position, range.start) && !isBefore(range.end, position);
}

/** Numbers of the sources at a position: those of the module there, else all of the statement. */
export function sourcesAt(sources: Source[], uri: string, position: Position): number[] {
  const numbersWith = (part: (source: Source) => Range | undefined): number[] =>
    sources.flatMap((source, number) =>
      source.uri === uri && holds(part(source), position) ? [number] : [],
    );
  const modules = numbersWith((source) => source.range);
  return modules.length > 0 ? modules : numbersWith((source) => source.statement);
}
