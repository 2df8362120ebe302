//! Rows of LTI as the tables hold them, and what they mean.

use super::model::{Context, DueItem, DueScore, Platform};
use crate::jobs::{StoreError, damaged, stored_id, stored_time};

/// Columns of a [`PlatformRow`], of a table or alias `p`.
macro_rules! platform_columns {
    () => {
        "p.id AS platform, p.teacher_id, p.issuer, p.client_id, p.auth_url, p.token_url, p.keys_url, p.deployments, p.created_at"
    };
}
pub(crate) use platform_columns;

#[derive(Debug, sqlx::FromRow)]
pub(crate) struct PlatformRow {
    platform: String,
    teacher_id: String,
    issuer: String,
    client_id: String,
    auth_url: String,
    token_url: String,
    keys_url: String,
    deployments: String,
    created_at: i64,
}

impl TryFrom<PlatformRow> for Platform {
    type Error = StoreError;

    fn try_from(row: PlatformRow) -> Result<Self, StoreError> {
        Ok(Self {
            id: stored_id(&row.platform)?,
            teacher: stored_id(&row.teacher_id)?,
            issuer: row.issuer,
            client_id: row.client_id,
            auth_url: row.auth_url,
            token_url: row.token_url,
            keys_url: row.keys_url,
            deployments: serde_json::from_str(&row.deployments)
                .map_err(|_| damaged("a platform with the deployments", &row.deployments))?,
            created_at: stored_time(row.created_at)?,
        })
    }
}

#[derive(Debug, sqlx::FromRow)]
pub(crate) struct ContextRow {
    id: String,
    platform_id: String,
    class_id: String,
    members_url: Option<String>,
    line_items_url: Option<String>,
}

impl TryFrom<ContextRow> for Context {
    type Error = StoreError;

    fn try_from(row: ContextRow) -> Result<Self, StoreError> {
        Ok(Self {
            id: stored_id(&row.id)?,
            platform: stored_id(&row.platform_id)?,
            class: stored_id(&row.class_id)?,
            members_url: row.members_url,
            line_items_url: row.line_items_url,
        })
    }
}

#[derive(Debug, sqlx::FromRow)]
pub(crate) struct DueItemRow {
    id: String,
    link: String,
    assignment_id: String,
    line_items_url: String,
    tries: i64,
    #[sqlx(flatten)]
    platform: PlatformRow,
}

impl TryFrom<DueItemRow> for DueItem {
    type Error = StoreError;

    fn try_from(row: DueItemRow) -> Result<Self, StoreError> {
        Ok(Self {
            id: stored_id(&row.id)?,
            link: row.link,
            assignment: stored_id(&row.assignment_id)?,
            platform: row.platform.try_into()?,
            line_items_url: row.line_items_url,
            tries: u32::try_from(row.tries).unwrap_or(u32::MAX),
        })
    }
}

#[derive(Debug, sqlx::FromRow)]
pub(crate) struct DueScoreRow {
    id: String,
    subject: String,
    line_item: String,
    points: Option<f64>,
    most: f64,
    at: i64,
    tries: i64,
    #[sqlx(flatten)]
    platform: PlatformRow,
}

impl TryFrom<DueScoreRow> for DueScore {
    type Error = StoreError;

    fn try_from(row: DueScoreRow) -> Result<Self, StoreError> {
        Ok(Self {
            id: stored_id(&row.id)?,
            platform: row.platform.try_into()?,
            subject: row.subject,
            line_item: row.line_item,
            points: row.points,
            most: row.most,
            at: stored_time(row.at)?,
            tries: u32::try_from(row.tries).unwrap_or(u32::MAX),
        })
    }
}
