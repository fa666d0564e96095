// SPDX-License-Identifier: MIT
// The list of messages below the editor, with buttons for their fixes.
import type { Diagnostic, Fix, Place } from 'lsys';
import { explain } from './explanations.js';

const kMaxShown = 50;

export interface MessageEvents {
  apply(fix: Fix): void;
  goTo(place: Place): void;
}

/** Appends `text` with its parts in back quotes as code. */
function appendText(parent: HTMLElement, text: string): void {
  text.split('`').forEach((part, index) => {
    if (index % 2 === 0) {
      parent.append(part);
    } else {
      const code = document.createElement('code');
      code.textContent = part;
      parent.append(code);
    }
  });
}

/** Opens to the explanation of a message. */
function reasonOf(code: string): HTMLElement {
  const details = document.createElement('details');
  details.className = 'reason';
  const summary = document.createElement('summary');
  summary.textContent = 'Why?';
  details.append(summary);
  details.addEventListener('toggle', async () => {
    if (!details.open || details.childElementCount > 1) return;
    for (const piece of await explain(code)) {
      if (piece.example) {
        const example = document.createElement('pre');
        example.className = piece.example;
        example.textContent = `// ${piece.example}\n${piece.text}`;
        details.append(example);
      } else {
        const paragraph = document.createElement('p');
        appendText(paragraph, piece.text);
        details.append(paragraph);
      }
    }
  });
  return details;
}

function itemOf(diagnostic: Diagnostic, events: MessageEvents): HTMLElement {
  const item = document.createElement('div');
  item.className = `message ${diagnostic.severity}`;
  const head = document.createElement('p');
  const severity = document.createElement('span');
  severity.className = 'severity';
  severity.textContent = `${diagnostic.severity}: `;
  head.append(severity);
  appendText(head, diagnostic.message);
  const { place } = diagnostic;
  if (place) {
    const where = document.createElement('button');
    where.type = 'button';
    where.className = 'where';
    where.textContent = `line ${place.line}`;
    where.addEventListener('click', () => events.goTo(place));
    head.append(' ', where);
  }
  item.append(head);
  for (const text of [diagnostic.label, ...diagnostic.notes, ...diagnostic.help]) {
    if (!text) continue;
    const line = document.createElement('p');
    line.className = 'help';
    appendText(line, text);
    item.append(line);
  }
  if (diagnostic.fixes.length > 0) {
    const fixes = document.createElement('div');
    fixes.className = 'fixes';
    for (const fix of diagnostic.fixes) {
      const button = document.createElement('button');
      button.type = 'button';
      button.className = fix.certain ? 'primary' : '';
      button.append('Fix: ');
      appendText(button, fix.title);
      button.addEventListener('click', () => events.apply(fix));
      fixes.append(button);
    }
    item.append(fixes);
  }
  if (diagnostic.code) item.append(reasonOf(diagnostic.code));
  return item;
}

/** Shows errors first, then warnings, then notes. */
export function showMessages(
  parent: HTMLElement,
  diagnostics: Diagnostic[],
  events: MessageEvents,
): void {
  const order = ['error', 'warning', 'note'];
  const sorted = [...diagnostics].sort(
    (a, b) => order.indexOf(a.severity) - order.indexOf(b.severity),
  );
  const items = sorted.slice(0, kMaxShown).map((each) => itemOf(each, events));
  if (sorted.length > kMaxShown) {
    const rest = document.createElement('div');
    rest.className = 'message';
    rest.textContent = `and ${sorted.length - kMaxShown} more`;
    items.push(rest);
  }
  parent.replaceChildren(...items);
}
