import { OpenPrtError } from '../error.js';

const kMagic = 0x46546c67; // "glTF"
const kJsonChunk = 0x4e4f534a;
const kBinaryChunk = 0x004e4942;

/** The two parts of a binary glTF. */
export interface Glb {
    json: unknown;
    /** Without a binary chunk, empty. */
    binary: Uint8Array;
}

/** Takes a binary glTF apart; lengths must fit to the byte. */
export function splitGlb(bytes: Uint8Array): Glb {
    const refuse = (why: string): never => {
        throw new OpenPrtError('malformed', why);
    };
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    if (bytes.length < 20 || view.getUint32(0, true) !== kMagic) refuse('the file is no binary glTF');
    if (view.getUint32(4, true) !== 2) refuse(`the file is binary glTF of version ${view.getUint32(4, true)}, not 2`);
    if (view.getUint32(8, true) !== bytes.length)
        refuse(`the file has ${bytes.length} bytes, and says that it has ${view.getUint32(8, true)}`);

    const chunks: { type: number; content: Uint8Array }[] = [];
    for (let begin = 12; begin < bytes.length; ) {
        if (bytes.length - begin < 8) refuse('a chunk of the file is cut off');
        const length = view.getUint32(begin, true);
        if (length % 4 !== 0 || length > bytes.length - begin - 8) refuse('a chunk of the file is cut off');
        chunks.push({ type: view.getUint32(begin + 4, true), content: bytes.subarray(begin + 8, begin + 8 + length) });
        begin += 8 + length;
    }
    if (chunks[0].type !== kJsonChunk) refuse('the first chunk of the file is not JSON');
    if (chunks.slice(2).some(({ type }) => type === kBinaryChunk)) refuse('the binary chunk of the file is not its second');
    const binary = chunks[1]?.type === kBinaryChunk ? chunks[1].content : new Uint8Array(0);
    return { json: parseJson(chunks[0].content), binary };
}

function parseJson(bytes: Uint8Array): unknown {
    try {
        return JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(bytes));
    } catch {
        throw new OpenPrtError('malformed', 'the JSON of the file cannot be parsed');
    }
}
