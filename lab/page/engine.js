// The engine as the page sees it: questions, answers, and a stop that always works.

export class Stopped extends Error {}

function bytesOf(id) {
  return Uint8Array.from(atob(document.getElementById(id).textContent.trim()), (letter) => letter.charCodeAt(0));
}

// What the page carries with it, compressed.
export async function unpacked(id) {
  const stream = new Blob([bytesOf(id)]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

let compiled = null;
function program() {
  compiled = compiled || (async () => ({
    script: new TextDecoder().decode(await unpacked('engine-script')),
    module: await WebAssembly.compile(await unpacked('engine-program')),
  }))();
  return compiled;
}

// A worker that is asked one question after the other.
export class Engine {
  constructor() {
    this.worker = null;
    this.current = null;  // {resolve, reject, onProgress}
    this.waiting = Promise.resolve();
    this.bytes = 0;
  }

  async begin() {
    const {script, module} = await program();
    const address = URL.createObjectURL(new Blob([script], {type: 'text/javascript'}));
    const worker = new Worker(address);
    URL.revokeObjectURL(address);
    await new Promise((resolve, reject) => {
      worker.onmessage = ({data}) => data.ready ? resolve() : reject(new Error(data.broken));
      worker.onerror = (event) => reject(new Error(event.message));
      worker.postMessage({module});
    });
    worker.onmessage = ({data}) => this.told(data);
    worker.onerror = (event) => this.told({broken: event.message});
    return worker;
  }

  told(data) {
    const current = this.current;
    if (!current) return;
    if (data.progress) {
      if (current.onProgress) current.onProgress(data.progress);
      return;
    }
    this.current = null;
    if (data.broken) {
      // Memory or stack ran out: what the worker has is of no use any more.
      this.end();
      current.reject(new Error('The engine gave up (' + data.broken + '). It has been started anew.'));
      return;
    }
    this.bytes = data.bytes;
    current.resolve(data);
  }

  end() {
    if (this.worker) this.worker.then((worker) => worker.terminate(), () => {});
    this.worker = null;
  }

  // {answer, rows, milliseconds, bytes}. Rejects with Stopped after stop().
  ask(question, onProgress = null) {
    const asked = this.waiting.then(async () => {
      this.worker = this.worker || this.begin();
      const starting = this.worker;
      const worker = await starting;
      return new Promise((resolve, reject) => {
        if (this.worker !== starting) return reject(new Stopped());
        this.current = {resolve, reject, onProgress};
        worker.postMessage({question});
      });
    });
    this.waiting = asked.catch(() => {});
    return asked;
  }

  get busy() { return this.current !== null; }

  // Ends what is being computed, at once; the next question starts a new worker.
  stop() {
    const current = this.current;
    this.current = null;
    this.end();
    if (current) current.reject(new Stopped());
  }
}
