//! Who arrives from a platform: their class, their person, and what the link that they followed leads to.

use super::super::{Connection, Pool, begin, classroom, now, while_submitting};
use crate::jobs::{StoreError, stored_id};
use crate::lti::rows::ContextRow;
use crate::lti::{Arrival, Arrived, Context, Enrolled, Link, Member, Role};
use uuid::Uuid;

/// Finds or makes class and person. Those of one course arrive one after another: two who come at once make one class.
pub(super) async fn arrive(pool: &Pool, arrival: &Arrival, most: i64) -> Result<Arrived, StoreError> {
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    let Arrival { platform, deployment, context, .. } = arrival;
    while_submitting(connection, &format!("lti {platform} {deployment} {context}")).await?;
    let context = match find(connection, arrival).await? {
        Some(context) => refresh(connection, context, arrival).await?,
        None => found(connection, arrival).await?,
    };
    let person = match arrival.role {
        Role::Teacher => staff(connection, context.class).await?,
        Role::Student => match student(connection, context.id, &arrival.subject).await? {
            Some(person) => person,
            None if is_full(connection, context.class, most).await? => return Ok(Arrived::Full),
            None => {
                let member = Member { subject: arrival.subject.clone(), person: arrival.student.clone() };
                admit(connection, &context, &member).await?;
                arrival.student.person.id
            }
        },
    };
    transaction.commit().await?;
    Ok(Arrived::In { person, context })
}

async fn find(connection: &mut Connection, arrival: &Arrival) -> Result<Option<Context>, StoreError> {
    let row: Option<ContextRow> =
        sqlx::query_as("SELECT * FROM lti_context WHERE platform_id = $1 AND deployment = $2 AND context = $3")
            .bind(arrival.platform.to_string())
            .bind(&arrival.deployment)
            .bind(&arrival.context)
            .fetch_optional(connection)
            .await?;
    row.map(Context::try_from).transpose()
}

/// Makes a course's class, and the account that has it.
async fn found(connection: &mut Connection, arrival: &Arrival) -> Result<Context, StoreError> {
    let at = now(connection).await?;
    classroom::insert_person(connection, &arrival.staff, None, at).await?;
    classroom::add_class(connection, &arrival.class).await?;
    let context = Context {
        id: Uuid::now_v7(),
        platform: arrival.platform,
        class: arrival.class.id,
        members_url: arrival.members_url.clone(),
        line_items_url: arrival.line_items_url.clone(),
    };
    sqlx::query(
        "INSERT INTO lti_context (id, platform_id, deployment, context, class_id, members_url, line_items_url) \
         VALUES ($1, $2, $3, $4, $5, $6, $7)",
    )
    .bind(context.id.to_string())
    .bind(context.platform.to_string())
    .bind(&arrival.deployment)
    .bind(&arrival.context)
    .bind(context.class.to_string())
    .bind(&context.members_url)
    .bind(&context.line_items_url)
    .execute(connection)
    .await?;
    Ok(context)
}

/// Services are where the latest launch says that they are; one that does not mention them changes nothing.
async fn refresh(connection: &mut Connection, context: Context, arrival: &Arrival) -> Result<Context, StoreError> {
    let members_url = arrival.members_url.clone().or(context.members_url);
    let line_items_url = arrival.line_items_url.clone().or(context.line_items_url);
    sqlx::query("UPDATE lti_context SET members_url = $2, line_items_url = $3 WHERE id = $1")
        .bind(context.id.to_string())
        .bind(&members_url)
        .bind(&line_items_url)
        .execute(connection)
        .await?;
    Ok(Context { members_url, line_items_url, ..context })
}

/// The account that has a class.
async fn staff(connection: &mut Connection, class: Uuid) -> Result<Uuid, StoreError> {
    let query = sqlx::query_scalar("SELECT teacher_id FROM class WHERE id = $1").bind(class.to_string());
    let teacher: String = query.fetch_one(connection).await?;
    stored_id(&teacher)
}

async fn student(connection: &mut Connection, context: Uuid, subject: &str) -> Result<Option<Uuid>, StoreError> {
    let person: Option<String> =
        sqlx::query_scalar("SELECT person_id FROM lti_member WHERE context_id = $1 AND subject = $2")
            .bind(context.to_string())
            .bind(subject)
            .fetch_optional(connection)
            .await?;
    person.as_deref().map(stored_id).transpose()
}

/// Whether a class has no room. Who joins by its code at this moment, too, waits.
async fn is_full(connection: &mut Connection, class: Uuid, most: i64) -> Result<bool, StoreError> {
    while_submitting(connection, &class.to_string()).await?;
    let query = sqlx::query_scalar("SELECT COUNT(*) FROM person WHERE class_id = $1").bind(class.to_string());
    let count: i64 = query.fetch_one(connection).await?;
    Ok(count >= most)
}

async fn admit(connection: &mut Connection, context: &Context, member: &Member) -> Result<(), StoreError> {
    let at = now(connection).await?;
    classroom::insert_person(connection, &member.person, Some(&context.class.to_string()), at).await?;
    sqlx::query("INSERT INTO lti_member (context_id, subject, person_id) VALUES ($1, $2, $3)")
        .bind(context.id.to_string())
        .bind(&member.subject)
        .bind(member.person.person.id.to_string())
        .execute(connection)
        .await?;
    Ok(())
}

pub(super) async fn known_as(pool: &Pool, student: Uuid) -> Result<Option<(String, String)>, StoreError> {
    let known = sqlx::query_as(
        "SELECT p.issuer, m.subject FROM lti_member m JOIN lti_context c ON c.id = m.context_id \
         JOIN lti_platform p ON p.id = c.platform_id WHERE m.person_id = $1",
    );
    Ok(known.bind(student.to_string()).fetch_optional(pool).await?)
}

pub(super) async fn is_course_account(pool: &Pool, person: Uuid) -> Result<bool, StoreError> {
    let courses: i64 = sqlx::query_scalar(
        "SELECT COUNT(*) FROM lti_context c JOIN class o ON o.id = c.class_id WHERE o.teacher_id = $1",
    )
    .bind(person.to_string())
    .fetch_one(pool)
    .await?;
    Ok(courses > 0)
}

pub(super) async fn context_of(pool: &Pool, class: Uuid) -> Result<Option<Context>, StoreError> {
    let query = sqlx::query_as("SELECT * FROM lti_context WHERE class_id = $1").bind(class.to_string());
    let row: Option<ContextRow> = query.fetch_optional(pool).await?;
    row.map(Context::try_from).transpose()
}

pub(super) async fn link(pool: &Pool, context: Uuid, link: &str) -> Result<Option<Link>, StoreError> {
    let row: Option<(String, String)> =
        sqlx::query_as("SELECT id, assignment_id FROM lti_link WHERE context_id = $1 AND link = $2")
            .bind(context.to_string())
            .bind(link)
            .fetch_optional(pool)
            .await?;
    row.map(|(id, assignment)| Ok(Link { id: stored_id(&id)?, assignment: stored_id(&assignment)? })).transpose()
}

pub(super) async fn set_link(
    pool: &Pool,
    context: Uuid,
    link: &str,
    assignment: Uuid,
    line_item: Option<&str>,
) -> Result<(), StoreError> {
    sqlx::query(
        "INSERT INTO lti_link (id, context_id, link, assignment_id, line_item, probe, tries, due_at) \
         VALUES ($1, $2, $3, $4, $5, '', 0, 0) ON CONFLICT (context_id, link) DO UPDATE SET \
         assignment_id = excluded.assignment_id, line_item = COALESCE(excluded.line_item, lti_link.line_item)",
    )
    .bind(Uuid::now_v7().to_string())
    .bind(context.to_string())
    .bind(link)
    .bind(assignment.to_string())
    .bind(line_item)
    .execute(pool)
    .await?;
    Ok(())
}

/// Takes over a list of members.
pub(super) async fn enroll(pool: &Pool, context: Uuid, members: &[Member], most: i64) -> Result<Enrolled, StoreError> {
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    let row: ContextRow = sqlx::query_as("SELECT * FROM lti_context WHERE id = $1")
        .bind(context.to_string())
        .fetch_one(&mut *connection)
        .await?;
    let context = Context::try_from(row)?;
    let mut enrolled = Enrolled { listed: members.len(), ..Enrolled::default() };
    for member in members {
        if let Some(known) = student(connection, context.id, &member.subject).await? {
            sqlx::query("UPDATE person SET name = $2, number = COALESCE($3, number) WHERE id = $1")
                .bind(known.to_string())
                .bind(&member.person.person.name)
                .bind(&member.person.person.number)
                .execute(&mut *connection)
                .await?;
        } else if is_full(connection, context.class, most).await? {
            enrolled.left_out += 1;
        } else {
            admit(connection, &context, member).await?;
            enrolled.added += 1;
        }
    }
    transaction.commit().await?;
    Ok(enrolled)
}
