// An experiment in the address of the page: #e= and its text, deflated, in the letters of base64url.

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

// What an address asks for: {text}, {chapter}, {experiment}, or nothing.
export async function asked(hash) {
  const found = /^#(e|chapter|experiment)=(.+)$/.exec(hash);
  if (!found) return {};
  if (found[1] === 'e') return {text: await unpackedText(found[2])};
  return {[found[1]]: found[1] === 'chapter' ? Number(found[2]) : decodeURIComponent(found[2])};
}
