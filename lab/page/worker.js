// The engine in its worker: one question at a time, an answer each. Stands behind the code that Emscripten makes.

function answerOf(engine, question) {
  const text = JSON.stringify(question);
  const size = engine.lengthBytesUTF8(text) + 1;
  const memory = engine._malloc(size);
  engine.stringToUTF8(text, memory, size);
  const answer = JSON.parse(engine.UTF8ToString(engine._courant_answer(memory)));
  engine._free(memory);
  return answer;
}

// The rows of a run, a copy.
function rowsOf(engine, i) {
  const count = engine._courant_row_values(i), first = engine._courant_rows(i) / 8;
  return engine.HEAPF64.slice(first, first + count);
}

function work(scope) {
  let engine = null;
  scope.onmessage = async ({data}) => {
    try {
      if (data.module) {
        engine = await courantEngine({
          instantiateWasm(imports, done) {
            WebAssembly.instantiate(data.module, imports).then((instance) => done(instance, data.module));
            return {};
          },
          onProgress: (step, steps, drift) => scope.postMessage({progress: {step, steps, drift}}),
        });
        scope.postMessage({ready: true});
        return;
      }
      const began = performance.now();
      const answer = answerOf(engine, data.question);
      const rows = (answer.runs || []).map((_, i) => rowsOf(engine, i));
      scope.postMessage({answer, rows, milliseconds: performance.now() - began, bytes: engine.HEAPU8.length},
                        rows.map((one) => one.buffer));
    } catch (error) {
      scope.postMessage({broken: String(error && error.message || error)});
    }
  };
}

if (typeof WorkerGlobalScope !== 'undefined') work(self);
