// Bibliography
//   [Khronos24]    Khronos PBR Neutral tone mapper
//   [Narkowicz15]  ACES filmic tone mapping curve
import { CustomToneMapping, LinearToneMapping, NeutralToneMapping, ShaderChunk, type ToneMapping } from 'three';

export const kToneCurves = ['none', 'aces', 'neutral'] as const;
export type ToneCurve = (typeof kToneCurves)[number];

/** What three.js calls them. Its own ACES is another fit, so that ours takes the place it leaves free; `none` is clamped. */
export const kToneMappings: Record<ToneCurve, ToneMapping> = { none: LinearToneMapping, aces: CustomToneMapping, neutral: NeutralToneMapping };

const kCustom = 'vec3 CustomToneMapping( vec3 color ) { return color; }';
const kSaturated = 100; // keeps the quotient from ∞/∞

ShaderChunk.tonemapping_pars_fragment = ShaderChunk.tonemapping_pars_fragment.replace(
    kCustom,
    `vec3 CustomToneMapping( vec3 color ) { // [Narkowicz15]
    vec3 x = clamp( toneMappingExposure * color, 0.0, ${kSaturated.toFixed(1)} );
    return saturate( x * ( 2.51 * x + 0.03 ) / ( x * ( 2.43 * x + 0.59 ) + 0.14 ) );
}`,
);

type Color = [number, number, number];

/** The same on the CPU: exposed linear radiance to display light in [0, 1]. */
export function applyToneCurve(curve: ToneCurve, [red, green, blue]: Color): Color {
    const bounded: Color = [Math.max(red, 0), Math.max(green, 0), Math.max(blue, 0)];
    const shown = curve === 'aces' ? bounded.map(acesOf) : curve === 'neutral' ? neutralOf(bounded) : bounded;
    return shown.map((value) => Math.min(value, 1)) as Color;
}

/** [Narkowicz15]; reaches 1 near 7. */
function acesOf(radiance: number): number {
    const x = Math.min(radiance, kSaturated);
    return (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
}

/** [Khronos24]. */
function neutralOf(color: Color): Color {
    const kFresnel = 0.04;
    const kCompressionStart = 0.8 - kFresnel;
    const kDesaturation = 0.15;
    const least = Math.min(...color);
    const offset = least > 2 * kFresnel ? kFresnel : least - least ** 2 / (4 * kFresnel);
    const matte = color.map((value) => value - offset) as Color;
    const peak = Math.max(...matte);
    if (peak <= kCompressionStart) return matte;
    const rest = 1 - kCompressionStart;
    const compressed = 1 - rest ** 2 / (peak + rest - kCompressionStart);
    const saturation = 1 / (kDesaturation * (peak - compressed) + 1);
    return matte.map((value) => value * (compressed / peak) * saturation + compressed * (1 - saturation)) as Color;
}

/** Display light to a code value of sRGB, 0 to 255. */
export function encodeSrgb8(linear: number): number {
    return Math.round(255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055));
}
