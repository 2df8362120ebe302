-- The same for SQLite and PostgreSQL. Times are microseconds since 1970, identifiers text, documents JSON. The queue has tables
-- called `Jobs` and `Workers` beside these, and SQLite does not tell `Jobs` from `jobs`: hence the singular.
CREATE TABLE job (
    id TEXT PRIMARY KEY,
    owner TEXT NOT NULL,
    kind TEXT NOT NULL,
    label TEXT,
    priority BIGINT NOT NULL,
    state TEXT NOT NULL,
    reason TEXT,
    cached BIGINT NOT NULL,
    attempts BIGINT NOT NULL DEFAULT 0,
    created_at BIGINT NOT NULL,
    started_at BIGINT,
    finished_at BIGINT,
    scenarios BIGINT NOT NULL,
    scenarios_done BIGINT NOT NULL,
    steps_total BIGINT NOT NULL,
    steps_done BIGINT NOT NULL,
    compute_us BIGINT NOT NULL DEFAULT 0,
    bytes BIGINT NOT NULL,
    event_seq BIGINT NOT NULL DEFAULT 0,
    webhook TEXT,
    idempotency_key TEXT,
    request_hash TEXT,
    UNIQUE (owner, idempotency_key)
);
CREATE INDEX job_of_owner ON job (owner, id);
-- A user's limits are sums over these two, asked for by every submission.
CREATE INDEX job_open ON job (owner, steps_total, steps_done) WHERE state IN ('queued', 'running');
CREATE INDEX job_bytes ON job (owner, bytes);
CREATE INDEX job_finished ON job (finished_at) WHERE finished_at IS NOT NULL;

CREATE TABLE job_scenario (
    job_id TEXT NOT NULL REFERENCES job (id) ON DELETE CASCADE,
    n BIGINT NOT NULL,
    hash TEXT NOT NULL,
    document TEXT NOT NULL,
    -- Version of the core whose result this is; absent until there is one.
    core_version TEXT,
    PRIMARY KEY (job_id, n)
);
CREATE INDEX job_scenario_hash ON job_scenario (hash);

CREATE TABLE shard (
    job_id TEXT NOT NULL REFERENCES job (id) ON DELETE CASCADE,
    number BIGINT NOT NULL,
    owner TEXT NOT NULL,
    priority BIGINT NOT NULL,
    first BIGINT NOT NULL,
    count BIGINT NOT NULL,
    state TEXT NOT NULL,
    -- Raised by every claim: whoever holds an older one may not write any more.
    attempt BIGINT NOT NULL DEFAULT 0,
    worker TEXT,
    lease_until BIGINT NOT NULL DEFAULT 0,
    not_before BIGINT NOT NULL DEFAULT 0,
    -- How often whoever worked on it vanished since it last came forward.
    kills BIGINT NOT NULL DEFAULT 0,
    steps_done BIGINT NOT NULL DEFAULT 0,
    PRIMARY KEY (job_id, number)
);
CREATE INDEX shard_queued ON shard (owner, priority DESC, job_id, number) WHERE state = 'queued';
CREATE INDEX shard_running ON shard (lease_until) WHERE state = 'running';

-- When a user's work was last taken up: who waited longest is next.
CREATE TABLE turn (
    owner TEXT PRIMARY KEY,
    served_at BIGINT NOT NULL
);

CREATE TABLE event (
    job_id TEXT NOT NULL REFERENCES job (id) ON DELETE CASCADE,
    seq BIGINT NOT NULL,
    kind TEXT NOT NULL,
    data TEXT NOT NULL,
    PRIMARY KEY (job_id, seq)
);

CREATE TABLE result (
    hash TEXT NOT NULL,
    core_version TEXT NOT NULL,
    report TEXT NOT NULL,
    bytes BIGINT NOT NULL,
    checksum TEXT NOT NULL,
    stored_at BIGINT NOT NULL,
    PRIMARY KEY (hash, core_version)
);

CREATE TABLE token (
    id TEXT PRIMARY KEY,
    owner TEXT NOT NULL,
    name TEXT NOT NULL,
    scopes TEXT NOT NULL,
    secret_hash TEXT NOT NULL,
    created_at BIGINT NOT NULL,
    expires_at BIGINT,
    revoked_at BIGINT,
    last_used_at BIGINT
);
