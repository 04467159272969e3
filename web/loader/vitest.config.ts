import { defineConfig } from 'vitest/config';

// Test files share what they import, which no test changes: half of the time goes without it into starting anew.
export default defineConfig({ test: { include: ['test/**/*.test.ts'], testTimeout: 60000, pool: 'threads', isolate: false } });
