// The page in a real browser: node check.mjs PAGE FEM_RUN CASES SCREENSHOTS
import './numbers.mjs';
import './faults.mjs';
import './reading.mjs';
import { runChecks } from './harness.mjs';

await runChecks();
