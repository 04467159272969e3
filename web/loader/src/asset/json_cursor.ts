import { OpenPrtError } from '../error.js';

/** A value of a JSON document and where it stands, so that a refusal can say so. */
export class JsonCursor {
    constructor(readonly value: unknown, readonly place: string) {}

    /** @param complaint  the rest of the sentence that begins with the place */
    reject(complaint: string): never {
        throw new OpenPrtError('malformed', `${this.place} ${complaint}`);
    }

    find(key: string): JsonCursor | undefined {
        const object = this.value;
        if (typeof object !== 'object' || object === null || Array.isArray(object)) this.reject('must be an object');
        if (!Object.hasOwn(object, key)) return undefined;
        return new JsonCursor((object as Record<string, unknown>)[key], `${this.place}.${key}`);
    }

    at(key: string): JsonCursor {
        return this.find(key) ?? this.reject(`lacks "${key}"`);
    }

    /** The elements of an array. */
    elements(): JsonCursor[] {
        if (!Array.isArray(this.value)) this.reject('must be an array');
        return (this.value as unknown[]).map((element, i) => new JsonCursor(element, `${this.place}[${i}]`));
    }

    keys(): string[] {
        if (typeof this.value !== 'object' || this.value === null || Array.isArray(this.value)) this.reject('must be an object');
        return Object.keys(this.value as object);
    }

    toText(): string {
        if (typeof this.value !== 'string') this.reject('must be a text');
        return this.value as string;
    }

    toNumber(): number {
        if (typeof this.value !== 'number' || !Number.isFinite(this.value)) this.reject('must be a number');
        return this.value as number;
    }

    toFlag(): boolean {
        if (typeof this.value !== 'boolean') this.reject('must be true or false');
        return this.value as boolean;
    }

    /** A whole number from 0 on. */
    toCount(least = 0, largest: number = Number.MAX_SAFE_INTEGER): number {
        const number = this.value;
        if (typeof number !== 'number' || !Number.isSafeInteger(number) || number < least || number > largest)
            this.reject(
                largest === Number.MAX_SAFE_INTEGER
                    ? 'must be a whole number' + (least > 0 ? ` from ${least} on` : '')
                    : `must be a whole number from ${least} to ${largest}`,
            );
        return number as number;
    }
}
