// SPDX-License-Identifier: MIT
// Colours of the grammar in the editor, and completion of statements and keys.
import { completeFromList } from '@codemirror/autocomplete';
import { HighlightStyle, StreamLanguage, type StreamParser } from '@codemirror/language';
import { tags } from '@lezer/highlight';

interface State {
  /** Whether the text is in a comment that began with `/*`. */
  comment: boolean;
  /** Keyword of the statement without `#`, or "production"; empty between statements. */
  statement: string;
}

const kStatements =
  /^#(?:n|w|include|define|param|set|let|function|curve|object|material|sense|ignore|consider|mode|decompose|interpret|down|up|choice|cut)\b/;

const parser: StreamParser<State> = {
  name: 'lsys',
  startState: () => ({ comment: false, statement: '' }),
  copyState: (state) => ({ ...state }),
  token(stream, state) {
    if (state.comment) {
      if (stream.match(/^.*?\*\//)) state.comment = false;
      else stream.skipToEnd();
      return 'comment';
    }
    if (stream.eatSpace()) return null;
    if (stream.match('//')) {
      stream.skipToEnd();
      return 'comment';
    }
    if (stream.match('/*')) {
      state.comment = true;
      return 'comment';
    }
    if (stream.match(/^"[^"]*"?/)) return 'string';
    if (stream.match(kStatements)) {
      state.statement = stream.current().slice(1);
      return 'keyword';
    }
    if (stream.match(/^#[A-Za-z_]\w*/)) {
      state.statement = 'production';
      return 'propertyName';
    }
    if (stream.match(/^(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?/)) return 'number';
    if (stream.match(/^\?[A-Za-z_]\w*/)) return 'typeName'; // a sense module
    if (stream.match(/^[A-Za-z_]\w*(?=\s*\()/)) return 'typeName';
    if (stream.match(/^[A-Za-z_]\w*/)) {
      const hasKeys = ['set', 'material', 'sense'].includes(state.statement);
      return hasKeys ? 'attributeName' : 'variableName';
    }
    const character = stream.next();
    if (character === ';') state.statement = '';
    if ('[]'.includes(character ?? '')) return 'squareBracket';
    return 'operator';
  },
  languageData: {
    commentTokens: { line: '//', block: { open: '/*', close: '*/' } },
    closeBrackets: { brackets: ['(', '[', '{', '"'] },
    autocomplete: completeFromList([
      { label: '#n', apply: '#n = ', type: 'keyword', detail: 'number of generations' },
      { label: '#w', apply: '#w : ', type: 'keyword', detail: 'axiom' },
      { label: '#param', apply: '#param name 1 {0, 2};', type: 'keyword', detail: 'a slider' },
      { label: '#define', apply: '#define ', type: 'keyword', detail: 'a constant' },
      { label: '#set angle', apply: '#set angle 25;', type: 'keyword', detail: 'degrees of + and -' },
      { label: '#set height', apply: '#set height 5;', type: 'keyword', detail: 'metres' },
      { label: '#set seed', apply: '#set seed 1;', type: 'keyword', detail: 'chance' },
      { label: '#object', apply: '#object leaf LEAF;', type: 'keyword', detail: 'a shape to draw' },
      { label: '#material', apply: '#material ', type: 'keyword', detail: 'look of a colour index' },
      { label: '#sense', apply: '#sense light shadow;', type: 'keyword', detail: 'what modules ?light ask' },
      { label: '#down', apply: '#down d : ', type: 'keyword', detail: 'a sweep from the tips to the base' },
      { label: '#up', apply: '#up u : ', type: 'keyword', detail: 'a sweep from the base to the tips' },
      { label: '?P', apply: '?P(0, 0, 0)', type: 'type', detail: 'asks for the position' },
      { label: '?H', apply: '?H(0, 0, 0)', type: 'type', detail: 'asks for the heading' },
      { label: '#function', apply: '#function f(x) x;', type: 'keyword', detail: 'a formula' },
      { label: '#curve', apply: '#curve c 0 0, 1 1;', type: 'keyword', detail: 'a curve of points' },
    ]),
  },
};

export const lsysLanguage = StreamLanguage.define(parser);

export const lsysColours = HighlightStyle.define([
  { tag: tags.comment, class: 'tok-comment' },
  { tag: tags.keyword, class: 'tok-keyword' },
  { tag: tags.propertyName, class: 'tok-name' },
  { tag: tags.typeName, class: 'tok-module' },
  { tag: tags.attributeName, class: 'tok-key' },
  { tag: tags.number, class: 'tok-number' },
  { tag: tags.string, class: 'tok-string' },
  { tag: tags.squareBracket, class: 'tok-branch' },
  { tag: tags.operator, class: 'tok-operator' },
]);
