/** Factors that lower bands against ringing [Sloan08]. */
export type ShWindow = 'none' | 'hann' | 'lanczos';

/** One factor a band: ½ (1 + cos(π l/n)) of hann, sin(π l/n) / (π l/n) of lanczos. The first is 1. */
export function windowFactors(window: ShWindow, bandCount: number): Float64Array {
    return Float64Array.from({ length: bandCount }, (_, l) => {
        const x = (Math.PI * l) / bandCount;
        if (window === 'none' || l === 0) return 1;
        return window === 'hann' ? 0.5 * (1 + Math.cos(x)) : Math.sin(x) / x;
    });
}
