// SPDX-License-Identifier: MIT
// The editor of the grammar. It is in a shadow root, where its styles need no exception from the
// Content-Security-Policy.
import { autocompletion, closeBrackets, completionKeymap } from '@codemirror/autocomplete';
import { defaultKeymap, history, historyKeymap } from '@codemirror/commands';
import { bracketMatching, syntaxHighlighting } from '@codemirror/language';
import { type Diagnostic as Mark, lintGutter, lintKeymap, setDiagnostics } from '@codemirror/lint';
import { highlightSelectionMatches, searchKeymap } from '@codemirror/search';
import { Annotation, EditorState, type Text } from '@codemirror/state';
import {
  drawSelection,
  EditorView,
  highlightActiveLine,
  keymap,
  lineNumbers,
} from '@codemirror/view';
import type { Diagnostic, Fix, Place } from 'lsys';
import { lsysColours, lsysLanguage } from './language.js';

const kStyle = `
:host { display: block; height: 100%; }
.cm-editor { height: 100%; background: var(--panel); color: var(--ink); }
.cm-editor.cm-focused { outline: none; }
.cm-editor .cm-scroller { font: 0.9rem/1.6 ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, monospace; }
.cm-editor .cm-gutters { border: 0; background: var(--panel); color: var(--soft); }
.cm-editor .cm-activeLine, .cm-editor .cm-activeLineGutter { background: color-mix(in srgb, var(--hover) 60%, transparent); }
.cm-editor .cm-cursor { border-left-color: var(--ink); }
.cm-editor .cm-tooltip, .cm-editor .cm-panels { background: var(--panel); color: var(--ink); border: 1px solid var(--line); }
.cm-editor .cm-diagnosticAction { background: var(--accent); color: var(--accent-ink); }
.cm-editor .cm-lintRange { background-image: none; text-decoration: underline wavy 1.5px; text-underline-offset: 3px; }
.cm-editor .cm-lintRange.cm-lintRange-error { text-decoration-color: var(--error); }
.cm-editor .cm-lintRange.cm-lintRange-warning { text-decoration-color: var(--warning); }
.cm-editor .cm-lintRange.cm-lintRange-info { text-decoration-color: var(--soft); }
.cm-editor .cm-lint-marker::before { content: '●'; font-size: 0.8rem; }
.cm-editor .cm-lint-marker.cm-lint-marker-error { content: normal; color: var(--error); }
.cm-editor .cm-lint-marker.cm-lint-marker-warning { content: normal; color: var(--warning); }
.cm-editor .cm-lint-marker.cm-lint-marker-info { content: normal; color: var(--soft); }
.tok-comment { color: var(--soft); font-style: italic; }
.tok-keyword { color: var(--accent); font-weight: 600; }
.tok-name { color: light-dark(#7a4a00, #e7b96b); }
.tok-key { color: light-dark(#6b3fa0, #c7a6f2); }
.tok-module { color: light-dark(#00567a, #86c8ee); }
.tok-number { color: light-dark(#9a3412, #f4a98a); }
.tok-string { color: light-dark(#80324f, #f0a6c0); }
.tok-branch { color: var(--accent); font-weight: 700; }
`;

/** Marks changes that the page makes, not the author. */
const fromPage = Annotation.define<boolean>();

function offsetIn(text: Text, line: number, column: number): number {
  if (line > text.lines) return text.length;
  const found = text.line(line);
  return Math.min(found.from + column - 1, found.to);
}

export interface EditorEvents {
  /** The author has changed the text. */
  changed(): void;
  /** The author asks to draw or to lay out the grammar. */
  draw(): void;
  format(): void;
}

export class Editor {
  private readonly view: EditorView;

  constructor(
    parent: HTMLElement,
    private readonly events: EditorEvents,
  ) {
    const root = parent.attachShadow({ mode: 'open' });
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(kStyle);
    root.adoptedStyleSheets = [sheet];
    const place = document.createElement('div');
    place.style.height = '100%';
    root.append(place);
    const pageKeys = keymap.of([
      { key: 'Mod-Enter', run: () => (events.draw(), true) },
      { key: 'Mod-Shift-f', run: () => (events.format(), true) },
    ]);
    this.view = new EditorView({
      root,
      parent: place,
      state: EditorState.create({
        extensions: [
          lineNumbers(),
          lintGutter(),
          history(),
          drawSelection(),
          bracketMatching(),
          closeBrackets(),
          autocompletion(),
          highlightActiveLine(),
          highlightSelectionMatches(),
          lsysLanguage,
          syntaxHighlighting(lsysColours),
          EditorView.lineWrapping,
          EditorView.contentAttributes.of({
            'aria-label': 'Grammar',
            autocapitalize: 'off',
            spellcheck: 'false',
            tabindex: '0',
          }),
          pageKeys,
          keymap.of([
            ...completionKeymap,
            ...lintKeymap,
            ...searchKeymap,
            ...historyKeymap,
            ...defaultKeymap,
          ]),
          EditorView.updateListener.of((update) => {
            if (update.docChanged && !update.transactions.some((each) => each.annotation(fromPage)))
              this.events.changed();
          }),
        ],
      }),
    });
  }

  get text(): string {
    return this.view.state.doc.toString();
  }

  /** Replaces the part of the text that differs, so that cursor and history survive. */
  setText(text: string, isNew = false): void {
    const old = this.text;
    let from = 0;
    while (from < old.length && old[from] === text[from]) ++from;
    let end = 0;
    const rest = Math.min(old.length, text.length) - from;
    while (end < rest && old[old.length - 1 - end] === text[text.length - 1 - end]) ++end;
    this.view.dispatch({
      changes: { from, to: old.length - end, insert: text.slice(from, text.length - end) },
      annotations: fromPage.of(true),
      ...(isNew ? { selection: { anchor: 0 }, scrollIntoView: true } : {}),
    });
  }

  /** Underlines the places of messages about the file `name`; `apply` applies a fix. */
  mark(diagnostics: Diagnostic[], name: string, apply: (fix: Fix) => void): void {
    const text = this.view.state.doc;
    const marks: Mark[] = [];
    for (const each of diagnostics) {
      if (each.place?.file !== name) continue;
      marks.push({
        from: offsetIn(text, each.place.line, each.place.column),
        to: offsetIn(text, each.place.endLine, each.place.endColumn),
        severity: each.severity === 'note' ? 'info' : each.severity,
        message: each.message,
        actions: each.fixes.map((fix) => ({ name: fix.title, apply: () => apply(fix) })),
      });
    }
    this.view.dispatch(setDiagnostics(this.view.state, marks));
  }

  focus(): void {
    this.view.focus();
  }

  goTo(place: Place): void {
    const at = offsetIn(this.view.state.doc, place.line, place.column);
    this.view.dispatch({ selection: { anchor: at }, scrollIntoView: true });
    this.view.focus();
  }
}
