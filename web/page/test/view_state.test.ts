import { describe, expect, it } from 'vitest';

import { type ViewState, formatHash, kDefaultState, parseHash, sideOf, wrapDegrees } from '../src/view_state.js';

const kAll: ViewState = {
    first: { asset: 1, transport: 'shadowed', bands: 3, window: 'hann' },
    other: { asset: 0, transport: 'interreflected', bands: 5, window: 'none' },
    light: 2,
    turnDegrees: -90.5,
    tiltDegrees: 12,
    exposureStops: -14.25,
    tone: 'none',
    background: false,
    split: 0.25,
    eye: [1, -2.5, 3e-7],
    target: [0, 1, 0],
    ui: false,
};

describe('the address', () => {
    it('of the default is empty, and says the default', () => {
        expect(formatHash(kDefaultState)).toBe('');
        expect(parseHash('')).toEqual(kDefaultState);
        expect(parseHash('#')).toEqual(kDefaultState);
    });

    it('holds all of a view', () => {
        expect(parseHash(formatHash(kAll))).toEqual(kAll);
    });

    it('is made of the keys that the documents name', () => {
        expect(formatHash({ ...kDefaultState, first: { transport: 'shadowed' }, light: 1, turnDegrees: 90, split: 0.5, other: { bands: 2 } })).toBe(
            '#transport=shadowed&light=1&turn=90&split=0.5&other.bands=2',
        );
    });

    it.each([
        'asset=-1', 'asset=1e999', 'asset=1.5', 'asset=99999', 'light=one', 'light=__proto__', 'transport=constructor', 'transport=toString', 'bands=0', 'bands=11',
        'bands=NaN', 'window=wide', 'turn=Infinity', 'turn=1e300', 'tilt=0x10', 'exposure=', 'exposure=auto', 'exposure=41', 'tone=<script>', 'background=2',
        'split=-0.1', 'split=2', 'split=', 'other.asset=x', 'eye=1,2', 'eye=1,2,3,4', 'eye=1,2,NaN', 'eye=,,', 'target=1e10,0,0', '%E0%A4%A', '&&==&=1', 'unknown=1',
        '__proto__=1', 'ui=1',
    ])('as if it were not there: %s', (hash) => {
        expect(formatHash(parseHash(`#${hash}`))).toBe('');
    });

    it('keeps what is right beside what is wrong', () => {
        expect(formatHash(parseHash('#bands=99&turn=450&light=x&tone=neutral'))).toBe('#turn=90&tone=neutral');
    });

    it('has no eye where the target is', () => {
        expect(formatHash(parseHash('#eye=1,2,3&target=1,2,3'))).toBe('#eye=1,2,3');
    });
});

describe('the second half', () => {
    it('is as the first but for what it has of its own', () => {
        expect(sideOf({ ...kAll, other: { bands: 2, window: undefined } }, 'other')).toEqual({ ...kAll.first, bands: 2 });
    });

    it('takes only the smoothing from the first where it shows another asset', () => {
        expect(sideOf({ ...kAll, other: { asset: 0 } }, 'other')).toEqual({ asset: 0, window: 'hann' });
    });
});

it('angles are wrapped to (−180, 180]', () => {
    expect([0, 180, -180, 181, 540, -725].map(wrapDegrees)).toEqual([0, 180, 180, -179, 180, -5]);
});
