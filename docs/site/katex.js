// Formulas to HTML: a line of JSON {"formula": …, "display": true} gives one {"html": …} or {"error": …}.
const katex = require('/usr/share/javascript/katex/katex.min.js');
const readline = require('readline');

readline.createInterface({ input: process.stdin }).on('line', (line) => {
  const { formula, display } = JSON.parse(line);
  let answer;
  try {
    answer = { html: katex.renderToString(formula, { displayMode: display, strict: 'error' }) };
  } catch (error) {
    answer = { error: error.message };
  }
  console.log(JSON.stringify(answer));
});
