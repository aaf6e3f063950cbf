/** Arrays as they lie in a file, behind a header that says what they are. */

/** The header and the arrays of what was packed. @param {ArrayBuffer} content */
export function unpacked(content) {
  const length = new DataView(content).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(content, 4, length)));
  const kinds = { f4: Float32Array, u4: Uint32Array, u2: Uint16Array, i1: Int8Array };
  const arrays = {};
  for (const [name, { dtype, shape, offset }] of Object.entries(header.arrays)) {
    const size = shape.reduce((product, each) => product * each, 1);
    arrays[name] = new kinds[dtype](content, 4 + length + offset, size);
  }
  return { header, arrays };
}
