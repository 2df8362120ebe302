-- Experiments: jobs whose runs follow from one document. Of a run one row of numbers is kept, packed with its neighbours'.
CREATE TABLE experiment (
    job_id TEXT PRIMARY KEY REFERENCES job (id) ON DELETE CASCADE,
    hash TEXT NOT NULL,
    document TEXT NOT NULL,
    -- Rows of two versions would not belong together.
    core_version TEXT NOT NULL,
    -- Steps of a tuning, one for each generation; anything else has one.
    step BIGINT NOT NULL DEFAULT 0,
    -- Runs of this step, how many of them have a row, and how many had when they were last summed up.
    planned BIGINT NOT NULL,
    done BIGINT NOT NULL DEFAULT 0,
    summed BIGINT NOT NULL DEFAULT 0,
    -- Shards come and go; no two of a job ever have the same number.
    next_shard BIGINT NOT NULL,
    -- The search of a tuning, as the steps before this one left it.
    state BYTEA,
    -- What the rows say, as JSON: so far, or in the end.
    summary TEXT
);

CREATE TABLE experiment_rows (
    job_id TEXT NOT NULL REFERENCES job (id) ON DELETE CASCADE,
    step BIGINT NOT NULL,
    first BIGINT NOT NULL,
    count BIGINT NOT NULL,
    packed BYTEA NOT NULL,
    PRIMARY KEY (job_id, step, first)
);

-- A shard computes what its numbers name, or folds the rows that there are.
ALTER TABLE shard ADD COLUMN folds BIGINT NOT NULL DEFAULT 0;
