const kPolynomial = 0xedb88320; // of ISO 3309, bits reversed

// Remainders of the 256 bytes, and of those followed by one, two and three zero bytes.
const kRemainders = makeRemainders();

function makeRemainders(): Uint32Array[] {
    const tables = [0, 1, 2, 3].map(() => new Uint32Array(256));
    for (let byte = 0; byte < 256; ++byte) {
        let remainder = byte;
        for (let bit = 0; bit < 8; ++bit) remainder = (remainder >>> 1) ^ (remainder & 1 ? kPolynomial : 0);
        tables[0][byte] = remainder;
    }
    for (let byte = 0; byte < 256; ++byte)
        for (let zeros = 1; zeros < 4; ++zeros) {
            const before = tables[zeros - 1][byte];
            tables[zeros][byte] = (before >>> 8) ^ tables[0][before & 255];
        }
    return tables;
}

/** The CRC-32 of ISO 3309, as zlib, PNG and gzip have it, in eight lower-case hexadecimal digits. Four bytes a step. */
export function checksumOf(bytes: Uint8Array): string {
    const [one, two, three, four] = kRemainders;
    let crc = 0xffffffff;
    let i = 0;
    for (const end = bytes.length - 3; i < end; i += 4) {
        crc ^= bytes[i] | (bytes[i + 1] << 8) | (bytes[i + 2] << 16) | (bytes[i + 3] << 24);
        crc = four[crc & 255] ^ three[(crc >>> 8) & 255] ^ two[(crc >>> 16) & 255] ^ one[crc >>> 24];
    }
    for (; i < bytes.length; ++i) crc = (crc >>> 8) ^ one[(crc ^ bytes[i]) & 255];
    return ((crc ^ 0xffffffff) >>> 0).toString(16).padStart(8, '0');
}
