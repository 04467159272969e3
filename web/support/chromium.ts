import { existsSync } from 'node:fs';
import { type Page, chromium } from 'playwright-core';

/** Debian's; another may be named by CHROMIUM. */
const kChromium = process.env.CHROMIUM ?? '/usr/bin/chromium';
export const hasBrowser = existsSync(kChromium);

/** A page in Chromium, headless, and what was said on its console that is no mere remark. */
export interface OpenPage {
    page: Page;
    complaints: string[];
    close(): Promise<void>;
}

export async function openChromium(url: string, viewport = { width: 1280, height: 720 }): Promise<OpenPage> {
    const browser = await chromium.launch({ executablePath: kChromium, args: ['--no-sandbox'] });
    const page = await browser.newPage({ viewport });
    const complaints: string[] = [];
    page.on('pageerror', (error) => complaints.push(String(error)));
    page.on('console', (message) => {
        if (['error', 'warning'].includes(message.type()) && !message.text().includes('GPU stall due to ReadPixels')) complaints.push(message.text());
    });
    await page.goto(url);
    return { page, complaints, close: () => browser.close() };
}
