// An experiment in the address of the page: #e= and its text, or #f= and {text, files}, deflated, in the letters of base64url.

const longest = 32000;  // letters of a fragment that programs hand on whole

async function through(bytes, stream) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

export async function packed(text) {
  const bytes = await through(new TextEncoder().encode(text), new CompressionStream('deflate-raw'));
  let letters = '';
  for (const byte of bytes) letters += String.fromCharCode(byte);
  return btoa(letters).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
}

// Throws where it is no such text.
export async function unpackedText(letters) {
  const bytes = Uint8Array.from(atob(letters.replace(/-/g, '+').replace(/_/g, '/')), (letter) => letter.charCodeAt(0));
  return new TextDecoder().decode(await through(bytes, new DecompressionStream('deflate-raw')));
}

// {fragment, left}: with the files, or with `left`, the names of those that do not fit.
export async function linkTo(text, files) {
  const names = Object.keys(files);
  if (names.length > 0) {
    const whole = '#f=' + await packed(JSON.stringify({text, files}));
    if (whole.length <= longest) return {fragment: whole, left: []};
  }
  return {fragment: '#e=' + await packed(text), left: names};
}

// What an address asks for: {text, files}, {chapter}, {experiment}, or nothing.
export async function asked(hash) {
  const found = /^#(e|f|chapter|experiment)=(.+)$/.exec(hash);
  if (!found) return {};
  if (found[1] === 'e') return {text: await unpackedText(found[2])};
  if (found[1] === 'f') {
    const {text, files} = JSON.parse(await unpackedText(found[2]));
    return {text, files};
  }
  return {[found[1]]: found[1] === 'chapter' ? Number(found[2]) : decodeURIComponent(found[2])};
}
