import { type Transport, type Vec3, kTransports } from 'openprt-three';

import { type ToneCurve, kToneCurves } from './picture/tone_curve.js';

export const kWindows = ['auto', 'none', 'hann', 'lanczos'] as const;
export type WindowName = (typeof kWindows)[number];

/** What one half of the picture shows; what is left out is the page's to choose. */
export interface Side {
    asset?: number | undefined;
    transport?: Transport | undefined;
    bands?: number | undefined;
    window?: WindowName | undefined;
}

/** All that decides the picture, as the address holds it behind #. */
export interface ViewState {
    first: Side;
    /** Of the half right of the split; what is left out is as in the first. */
    other: Side;
    light: number;
    /** The light's turn about +y, and its tilt about x before that. */
    turnDegrees: number;
    tiltDegrees: number;
    /** Absent: chosen for the light. */
    exposureStops?: number | undefined;
    tone: ToneCurve;
    background: boolean;
    /** Where the second half begins, 0 to 1; absent: there is none. */
    split?: number | undefined;
    /** Absent: as the asset comes. */
    eye?: Vec3 | undefined;
    target?: Vec3 | undefined;
    /** Whether there is more than the picture. */
    ui: boolean;
}

export const kDefaultState: Readonly<ViewState> = {
    first: {},
    other: {},
    light: 0,
    turnDegrees: 0,
    tiltDegrees: 0,
    tone: 'aces',
    background: true,
    ui: true,
};

export type SideName = 'first' | 'other';

/** What a half shows, with what the second takes from the first. */
export function sideOf({ first, other }: ViewState, name: SideName): Side {
    if (name === 'first') return first;
    // Another asset has bands and transport of its own.
    const common = other.asset === undefined || other.asset === (first.asset ?? 0) ? first : { window: first.window };
    const own = Object.entries(other).filter(([, value]) => value !== undefined);
    return { ...common, ...Object.fromEntries(own) };
}

/** One key of the address: what its text says of the state, and the text that says it; none where that is the default. */
interface Key {
    name: string;
    read(text: string, state: ViewState): void;
    write(state: ViewState): string | undefined;
}

const kMostIndex = 9999;
const kMostBands = 10;
const kMostStops = 40;
const kMostMetres = 1e9;
const kMostDegrees = 36000;

/** A number in decimal, within limits; else undefined. */
function parseNumber(text: string, least: number, most: number): number | undefined {
    const value = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(text) ? Number(text) : NaN;
    return value >= least && value <= most ? value : undefined;
}

function parseCount(text: string, least: number, most: number): number | undefined {
    return /^\d+$/.test(text) ? parseNumber(text, least, most) : undefined;
}

function parseName<Name extends string>(text: string, names: readonly Name[]): Name | undefined {
    return names.find((name) => name === text);
}

function parsePoint(text: string): Vec3 | undefined {
    const [x, y, z, ...more] = text.split(',').map((part) => parseNumber(part, -kMostMetres, kMostMetres));
    return x === undefined || y === undefined || z === undefined || more.length > 0 ? undefined : [x, y, z];
}

function formatNumber(value: number): string {
    return String(Number(value.toFixed(4)));
}

function formatPoint(point: Vec3 | undefined): string | undefined {
    return point?.map((value) => String(Number(value.toPrecision(6)))).join(',');
}

function withoutZero(text: string): string | undefined {
    return text === '0' || text === '-0' ? undefined : text;
}

/** An angle in (−180, 180]. */
export function wrapDegrees(degrees: number): number {
    const wrapped = ((degrees % 360) + 360) % 360;
    return wrapped > 180 ? wrapped - 360 : wrapped;
}

function sideKeys(name: SideName): Key[] {
    const prefix = name === 'first' ? '' : 'other.';
    return [
        {
            name: `${prefix}asset`,
            read: (text, state) => void (state[name].asset = parseCount(text, 0, kMostIndex)),
            write: (state) => (name === 'first' && !state.first.asset ? undefined : state[name].asset?.toString()),
        },
        {
            name: `${prefix}transport`,
            read: (text, state) => void (state[name].transport = parseName(text, kTransports)),
            write: (state) => state[name].transport,
        },
        {
            name: `${prefix}bands`,
            read: (text, state) => void (state[name].bands = parseCount(text, 1, kMostBands)),
            write: (state) => state[name].bands?.toString(),
        },
        {
            name: `${prefix}window`,
            read: (text, state) => void (state[name].window = parseName(text, kWindows)),
            write: (state) => (name === 'first' && state.first.window === 'auto' ? undefined : state[name].window),
        },
    ];
}

const kKeys: readonly Key[] = [
    ...sideKeys('first'),
    {
        name: 'light',
        read: (text, state) => void (state.light = parseCount(text, 0, kMostIndex) ?? kDefaultState.light),
        write: ({ light }) => withoutZero(String(light)),
    },
    {
        name: 'turn',
        read: (text, state) => void (state.turnDegrees = wrapDegrees(parseNumber(text, -kMostDegrees, kMostDegrees) ?? 0)),
        write: ({ turnDegrees }) => withoutZero(formatNumber(turnDegrees)),
    },
    {
        name: 'tilt',
        read: (text, state) => void (state.tiltDegrees = wrapDegrees(parseNumber(text, -kMostDegrees, kMostDegrees) ?? 0)),
        write: ({ tiltDegrees }) => withoutZero(formatNumber(tiltDegrees)),
    },
    {
        name: 'exposure',
        read: (text, state) => void (state.exposureStops = parseNumber(text, -kMostStops, kMostStops)),
        write: ({ exposureStops }) => (exposureStops === undefined ? undefined : formatNumber(exposureStops)),
    },
    {
        name: 'tone',
        read: (text, state) => void (state.tone = parseName(text, kToneCurves) ?? kDefaultState.tone),
        write: ({ tone }) => (tone === kDefaultState.tone ? undefined : tone),
    },
    {
        name: 'background',
        read: (text, state) => void (state.background = parseName(text, ['0', '1']) !== '0'),
        write: ({ background }) => (background ? undefined : '0'),
    },
    {
        name: 'split',
        read: (text, state) => void (state.split = parseNumber(text, 0, 1)),
        write: ({ split }) => (split === undefined ? undefined : formatNumber(split)),
    },
    ...sideKeys('other'),
    { name: 'eye', read: (text, state) => void (state.eye = parsePoint(text)), write: ({ eye }) => formatPoint(eye) },
    { name: 'target', read: (text, state) => void (state.target = parsePoint(text)), write: ({ target }) => formatPoint(target) },
    { name: 'ui', read: (text, state) => void (state.ui = text !== '0'), write: ({ ui }) => (ui ? undefined : '0') },
];

/** Reads what stands behind # in an address; what cannot be is as if it were not there. */
export function parseHash(hash: string): ViewState {
    const state: ViewState = { ...kDefaultState, first: {}, other: {} };
    const texts = new URLSearchParams(hash.replace(/^#/, ''));
    for (const key of kKeys) {
        const text = texts.get(key.name);
        if (text !== null) key.read(text, state);
    }
    if (state.eye && state.eye.join() === state.target?.join()) delete state.target;
    return state;
}

/** The same the other way: '' of the default, else '#key=value&…'. */
export function formatHash(state: ViewState): string {
    const parts = kKeys.flatMap((key) => {
        const text = key.write(state);
        return text === undefined ? [] : [`${key.name}=${text}`];
    });
    return parts.length > 0 ? `#${parts.join('&')}` : '';
}
