// A chapter of the tour: its idea, a question before one looks, and an answer that folds.
import {element} from './dom.js';

// The words of chapters are markup, made by the engine when the page was built.
function set(tag, attributes, markup, ...before) {
  const made = element(tag, attributes, ...before), words = element('span');
  words.innerHTML = markup;
  made.append(words);
  return made;
}

function paragraphs(text) { return text.split('\n').map((line) => set('p', {}, line)); }

// show(number) opens another chapter; again() puts the experiment of the chapter back.
export function showChapter(parent, chapters, number, {show, again, close}) {
  const chapter = chapters[number - 1];
  const go = (to, label, sign) => element('button', {type: 'button', disabled: to < 1 || to > chapters.length, 'aria-label': label, title: label, onclick: () => show(to)}, sign);
  const fold = (title, text) => element('details', {}, element('summary', {}, title), ...paragraphs(text));
  parent.replaceChildren(
    element('div', {class: 'line'},
      element('p', {class: 'soft'}, 'The tour, chapter ' + number + ' of ' + chapters.length),
      element('span', {class: 'buttons'}, go(number - 1, 'Chapter before', '‹'), go(number + 1, 'Next chapter', '›'),
        element('button', {type: 'button', 'aria-label': 'Leave the tour', title: 'Leave the tour', onclick: close}, '×'))),
    element('h2', {}, chapter.title),
    ...paragraphs(chapter.idea),
    set('p', {class: 'question'}, chapter.question, element('b', {}, 'Question. ')),
    fold('Answer', chapter.answer),
    set('p', {class: 'question'}, chapter.exercise, element('b', {}, 'Exercise. ')),
    fold('Solution', chapter.solution),
    element('p', {}, element('button', {type: 'button', onclick: again}, 'The experiment of the chapter again')));
  parent.hidden = false;
}
