export type ErrorCode = 'malformed' | 'unsupported' | 'invalidOption';

/** Outside data is wrong, in one sentence: what, where, and what was expected. */
export class OpenPrtError extends Error {
    override readonly name = 'OpenPrtError';

    constructor(readonly code: ErrorCode, sentence: string) {
        super(sentence);
    }
}
