// The text of the experiment: completion by the schema, and problems under their lines.
import {autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap} from '@codemirror/autocomplete';
import {defaultKeymap, history, historyKeymap} from '@codemirror/commands';
import {json} from '@codemirror/lang-json';
import {bracketMatching, HighlightStyle, indentOnInput, indentUnit, syntaxHighlighting} from '@codemirror/language';
import {EditorState, Prec, StateEffect, StateField} from '@codemirror/state';
import {Decoration, drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers, WidgetType} from '@codemirror/view';
import {tags} from '@lezer/highlight';
import {getLocation, parse} from 'jsonc-parser';

class Message extends WidgetType {
  constructor(text) { super(); this.text = text; }
  eq(other) { return other.text === this.text; }
  toDOM() {
    const line = document.createElement('div');
    line.className = 'problem';
    line.textContent = this.text;
    return line;
  }
  ignoreEvent() { return true; }
}

const setProblems = StateEffect.define();

// A wavy line under the place, the words under the line.
const problems = StateField.define({
  create: () => Decoration.none,
  update(marks, change) {
    marks = marks.map(change.changes);
    for (const effect of change.effects) {
      if (!effect.is(setProblems)) continue;
      const all = [], length = change.state.doc.length;
      for (const {from, to, what} of effect.value) {
        const [a, b] = [Math.min(from, length), Math.min(to, length)];
        if (b > a) all.push(Decoration.mark({class: 'wrong'}).range(a, b));
        all.push(Decoration.widget({widget: new Message(what), block: true, side: 1}).range(change.state.doc.lineAt(a).to));
      }
      marks = Decoration.set(all, true);
    }
    return marks;
  },
  provide: (field) => EditorView.decorations.from(field),
});

function completion(schema) {
  return (context) => {
    const text = context.state.doc.toString();
    const place = getLocation(text, context.pos);
    const value = parse(text, [], {allowTrailingComma: true});
    const word = context.matchBefore(/"?[\w-]*/);
    if (!word || (word.from === word.to && !context.explicit)) return null;
    const quoted = text[word.from] === '"';
    const from = quoted ? word.from : word.from, closes = text[context.pos] === '"';
    if (place.isAtPropertyKey) {
      const path = place.path.slice(0, -1);
      const holder = path.reduce((at, step) => at && at[step], value) || {};
      const colon = /^"?\s*:/.test(text.slice(context.pos));
      return {from, to: closes ? context.pos + 1 : context.pos, validFor: /^"?[\w-]*$/,
              options: schema.keys(path, value).filter(({key}) => holder[key] === undefined)
                .map(({key, description}) => ({label: '"' + key + '"', displayLabel: key, info: description || undefined, type: 'property',
                                               apply: '"' + key + '"' + (colon ? '' : ': ')}))};
    }
    const words = schema.words(place.path, value);
    if (words.length === 0) return null;
    return {from, to: closes && quoted ? context.pos + 1 : context.pos, validFor: /^"?[\w-]*$/,
            options: words.map(({value: one, description}) => ({label: JSON.stringify(one), displayLabel: String(one), info: description || undefined,
                                                                type: 'enum'}))};
  };
}

const colours = HighlightStyle.define([
  {tag: tags.propertyName, class: 'json-key'},
  {tag: tags.string, class: 'json-text'},
  {tag: [tags.number, tags.bool, tags.null], class: 'json-number'},
  {tag: [tags.brace, tags.squareBracket, tags.separator], class: 'json-mark'},
]);

export class Editor {
  // onEdit(text) after each change by its user; onRun() for Ctrl and Enter.
  constructor(parent, schema, {onEdit, onRun}) {
    this.silent = false;
    this.view = new EditorView({
      parent,
      state: EditorState.create({
        extensions: [
          lineNumbers(), history(), drawSelection(), indentOnInput(), bracketMatching(), closeBrackets(), highlightActiveLine(),
          json(), syntaxHighlighting(colours), indentUnit.of('  '), EditorView.lineWrapping, problems,
          autocompletion({override: [completion(schema)], icons: false}),
          Prec.highest(keymap.of([{key: 'Mod-Enter', run: () => { onRun(); return true; }}])),
          keymap.of([...closeBracketsKeymap, ...defaultKeymap, ...historyKeymap, ...completionKeymap]),
          EditorView.contentAttributes.of({'aria-label': 'The experiment, in JSON', spellcheck: 'false', autocapitalize: 'off', autocorrect: 'off'}),
          EditorView.updateListener.of((update) => {
            if (update.docChanged && !this.silent) onEdit(this.text);
          }),
        ],
      }),
    });
  }

  get text() { return this.view.state.doc.toString(); }

  // A text from elsewhere; nobody is told.
  set text(text) {
    this.silent = true;
    this.view.dispatch({changes: {from: 0, to: this.view.state.doc.length, insert: text}});
    this.silent = false;
  }

  // Edits of jsonc-parser; nobody is told.
  change(edits) {
    this.silent = true;
    this.view.dispatch({changes: edits.map(({offset, length, content}) => ({from: offset, to: offset + length, insert: content}))});
    this.silent = false;
  }

  mark(places) { this.view.dispatch({effects: setProblems.of(places)}); }
}
