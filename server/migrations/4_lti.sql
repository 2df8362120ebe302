-- Learning platforms (LTI 1.3), and what of theirs is what of ours. The same for SQLite and PostgreSQL; times are
-- microseconds since 1970.

CREATE TABLE lti_platform (
    id TEXT PRIMARY KEY,
    -- Who registered it.
    teacher_id TEXT NOT NULL REFERENCES person (id) ON DELETE CASCADE,
    issuer TEXT NOT NULL,
    client_id TEXT NOT NULL,
    auth_url TEXT NOT NULL,
    token_url TEXT NOT NULL,
    keys_url TEXT NOT NULL,
    -- A JSON list.
    deployments TEXT NOT NULL,
    created_at BIGINT NOT NULL,
    UNIQUE (issuer, client_id)
);

-- Launches that were let in: none is let in twice.
CREATE TABLE lti_nonce (
    nonce TEXT PRIMARY KEY,
    expires_at BIGINT NOT NULL
);
CREATE INDEX lti_nonce_expiry ON lti_nonce (expires_at);

-- What a page of ours hands in once, by its hash.
CREATE TABLE lti_ticket (
    hash TEXT PRIMARY KEY,
    data TEXT NOT NULL,
    expires_at BIGINT NOT NULL
);
CREATE INDEX lti_ticket_expiry ON lti_ticket (expires_at);

-- A platform's course and our class.
CREATE TABLE lti_context (
    id TEXT PRIMARY KEY,
    platform_id TEXT NOT NULL REFERENCES lti_platform (id) ON DELETE CASCADE,
    deployment TEXT NOT NULL,
    context TEXT NOT NULL,
    class_id TEXT NOT NULL UNIQUE REFERENCES class (id) ON DELETE CASCADE,
    -- Its list of members and its gradebook, as the last launch named them.
    members_url TEXT,
    line_items_url TEXT,
    UNIQUE (platform_id, deployment, context)
);

-- A platform's user in a course, and our student.
CREATE TABLE lti_member (
    context_id TEXT NOT NULL REFERENCES lti_context (id) ON DELETE CASCADE,
    subject TEXT NOT NULL,
    person_id TEXT NOT NULL UNIQUE REFERENCES person (id) ON DELETE CASCADE,
    PRIMARY KEY (context_id, subject)
);

-- A link in a course and our assignment.
CREATE TABLE lti_link (
    id TEXT PRIMARY KEY,
    context_id TEXT NOT NULL REFERENCES lti_context (id) ON DELETE CASCADE,
    link TEXT NOT NULL,
    assignment_id TEXT NOT NULL REFERENCES assignment (id) ON DELETE CASCADE,
    -- The gradebook's column; unknown until the platform names it or we make it.
    line_item TEXT,
    -- What the scores were last made from.
    probe TEXT NOT NULL,
    -- Of making the column.
    tries BIGINT NOT NULL,
    due_at BIGINT NOT NULL,
    error TEXT,
    UNIQUE (context_id, link)
);
CREATE INDEX lti_link_of_assignment ON lti_link (assignment_id);

-- The score that a platform should have; it is kept until the platform has it, and after that to be compared with.
CREATE TABLE lti_score (
    id TEXT PRIMARY KEY,
    link_id TEXT NOT NULL REFERENCES lti_link (id) ON DELETE CASCADE,
    person_id TEXT NOT NULL REFERENCES person (id) ON DELETE CASCADE,
    -- Without points: the mark was taken back.
    points DOUBLE PRECISION,
    most DOUBLE PRECISION NOT NULL,
    -- When it became what it is; later scores of a student have later times.
    at BIGINT NOT NULL,
    sent_at BIGINT,
    tries BIGINT NOT NULL,
    due_at BIGINT NOT NULL,
    error TEXT,
    UNIQUE (link_id, person_id)
);
CREATE INDEX lti_score_due ON lti_score (due_at) WHERE sent_at IS NULL;
