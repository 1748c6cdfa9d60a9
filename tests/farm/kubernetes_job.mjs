// Validates a job for Kubernetes, and three spoilt ones.
//   node kubernetes_job.mjs JOB.json
import assert from "node:assert";
import { readFileSync } from "node:fs";
import { Job } from "kubernetes-models/batch/v1";

const text = readFileSync(process.argv[2], "utf8");
new Job(JSON.parse(text)).validate();
const spoil = [
    (job) => { job.spec.completions = "two"; },
    (job) => { delete job.spec.template; },
    (job) => { job.spec.template.spec.containers[0].volumeMounts[0].mountPath = 3; },
];
for (const change of spoil) {
    const job = JSON.parse(text);
    change(job);
    assert.throws(() => new Job(job).validate(), String(change));
}
