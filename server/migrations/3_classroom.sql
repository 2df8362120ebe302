-- Classes, their people, and what they hand in. The same for SQLite and PostgreSQL; times are microseconds since 1970.

-- Random texts that all servers of this database share: seeds of variants are derived from one.
CREATE TABLE classroom_secret (
    name TEXT PRIMARY KEY,
    value TEXT NOT NULL
);

CREATE TABLE class (
    id TEXT PRIMARY KEY,
    teacher_id TEXT NOT NULL,
    name TEXT NOT NULL,
    code TEXT NOT NULL,
    -- Codes are looked for by their hash: how far a guess is right shows in no comparison.
    code_hash TEXT NOT NULL UNIQUE,
    joining BIGINT NOT NULL,
    created_at BIGINT NOT NULL
);
CREATE INDEX class_of_teacher ON class (teacher_id, id);

CREATE TABLE person (
    id TEXT PRIMARY KEY,
    role TEXT NOT NULL,
    -- A student's class; a teacher has none.
    class_id TEXT REFERENCES class (id) ON DELETE CASCADE,
    name TEXT NOT NULL,
    number TEXT,
    login TEXT NOT NULL UNIQUE,
    key_hash TEXT NOT NULL UNIQUE,
    password TEXT,
    created_at BIGINT NOT NULL
);
CREATE INDEX person_of_class ON person (class_id, id);

CREATE TABLE invitation (
    hash TEXT PRIMARY KEY,
    -- 1 for the links that the server prints.
    printed BIGINT NOT NULL,
    expires_at BIGINT NOT NULL
);

CREATE TABLE session (
    hash TEXT PRIMARY KEY,
    person_id TEXT NOT NULL REFERENCES person (id) ON DELETE CASCADE,
    created_at BIGINT NOT NULL,
    used_at BIGINT NOT NULL
);
CREATE INDEX session_of_person ON session (person_id);

CREATE TABLE assignment (
    id TEXT PRIMARY KEY,
    class_id TEXT NOT NULL REFERENCES class (id) ON DELETE CASCADE,
    exercise TEXT NOT NULL,
    -- The exercise as it was when it was given out: a newer library does not change marks.
    document TEXT NOT NULL,
    settings TEXT NOT NULL,
    created_at BIGINT NOT NULL
);
CREATE INDEX assignment_of_class ON assignment (class_id, id);

CREATE TABLE extension (
    assignment_id TEXT NOT NULL REFERENCES assignment (id) ON DELETE CASCADE,
    person_id TEXT NOT NULL REFERENCES person (id) ON DELETE CASCADE,
    deadline BIGINT,
    attempts BIGINT NOT NULL,
    comment TEXT NOT NULL,
    PRIMARY KEY (assignment_id, person_id)
);

CREATE TABLE attempt (
    id TEXT PRIMARY KEY,
    assignment_id TEXT NOT NULL REFERENCES assignment (id) ON DELETE CASCADE,
    person_id TEXT NOT NULL REFERENCES person (id) ON DELETE CASCADE,
    number BIGINT NOT NULL,
    gains TEXT NOT NULL,
    idempotency_key TEXT,
    -- The job may be forgotten before the attempt is.
    job_id TEXT NOT NULL,
    state TEXT NOT NULL,
    reason TEXT,
    submitted_at BIGINT NOT NULL,
    graded_at BIGINT,
    -- What its student may see of the grade, all of it, and the signed receipt.
    feedback TEXT,
    grade TEXT,
    receipt TEXT,
    UNIQUE (assignment_id, person_id, number),
    UNIQUE (assignment_id, person_id, idempotency_key)
);
CREATE INDEX attempt_of_person ON attempt (person_id);
CREATE INDEX attempt_grading ON attempt (id) WHERE state = 'grading';

-- Every override that was ever made; the latest counts.
CREATE TABLE mark_override (
    id TEXT PRIMARY KEY,
    assignment_id TEXT NOT NULL REFERENCES assignment (id) ON DELETE CASCADE,
    person_id TEXT NOT NULL REFERENCES person (id) ON DELETE CASCADE,
    teacher_id TEXT NOT NULL,
    points DOUBLE PRECISION,
    comment TEXT NOT NULL,
    at BIGINT NOT NULL
);
CREATE INDEX mark_override_of ON mark_override (assignment_id, person_id, id);

-- What teachers did, by identifiers alone: who is erased leaves no name here.
CREATE TABLE audit (
    id TEXT PRIMARY KEY,
    class_id TEXT NOT NULL REFERENCES class (id) ON DELETE CASCADE,
    teacher_id TEXT NOT NULL,
    at BIGINT NOT NULL,
    what TEXT NOT NULL,
    data TEXT NOT NULL
);
CREATE INDEX audit_of_class ON audit (class_id, id);
