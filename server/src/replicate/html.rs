//! The replication as one HTML page that needs nothing else: styles and figures are inside.

use super::{Replication, cells};
use adaptarm_core::experiments::replication::{IndexTable, OBSERVER_PEAKS_DEG, Verdict};
use adaptarm_core::figures::Figure;
use adaptarm_core::scenario::Scheme;
use maud::{DOCTYPE, Markup, PreEscaped, html};

const STYLE: &str = include_str!("report.css");

/// The whole page.
pub(super) fn page(replication: &Replication, figures: &[(Figure, String)]) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Adaptive control with a velocity observer: replication" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                main {
                    h1 { "Adaptive control of a robot arm with a velocity observer: replication" }
                    p.lead { "Three controllers on the first three joints of a CRS A465. " (replication.settings()) ". Core version " (replication.core_version) "." }
                    (outcomes(replication))
                    h2 { "Tables" }
                    @for table in &replication.tables { (index_table(replication, table)) }
                    (observer_peaks(replication))
                    h2 { "Claims of the paper" }
                    p { "Each with our criterion and the numbers behind the verdict; a verdict holds for these settings only." }
                    (claims(replication))
                    h2 { "Figures" }
                    @for (figure, svg) in figures { (figure_block(*figure, svg)) }
                    h2 { "Assumptions" }
                    p { "What the source leaves unsaid or misprints, and what stands in its place." }
                    (assumptions(replication))
                    h2 { "Runs" }
                    (runs(replication))
                    p { "The folder of this page holds the scenarios, all samples as CSV, the figures as SVG and PNG, and this report as JSON." }
                }
            }
        }
    };
    page.into_string()
}

fn outcomes(replication: &Replication) -> Markup {
    html! {
        @for report in &replication.reports {
            @if let (Some(at_s), Some(reason)) = (report.at_s, &report.reason) {
                p.bad role="note" { (report.scheme) " diverged at " (format!("{at_s:.4}")) " s: " (reason) ". Its numbers up to then are in report.json; in the tables below they would say nothing." }
            }
        }
    }
}

fn index_table(replication: &Replication, table: &IndexTable) -> Markup {
    html! {
        div.scroll { table {
            caption { "Table " (table.number) ". " (table.title) " [" (table.unit) "]" }
            thead {
                tr {
                    th rowspan="2" scope="col" { "Scheme" }
                    @for joint in 1..=3 { th.group colspan="3" scope="colgroup" { "joint " (joint) } }
                }
                tr { @for _ in 1..=3 { th scope="col" { "ours" } th scope="col" { "paper" } th scope="col" { "ratio" } } }
            }
            tbody {
                @for (scheme, name, entries) in &table.rows {
                    @let diverged = replication.diverged(scheme);
                    tr {
                        th scope="row" { (name) }
                        @for entry in entries {
                            td { (cells::ours(diverged, entry.ours)) }
                            td { (entry.paper) }
                            td.ratio { (cells::ratio(diverged, entry.ratio, 1)) }
                        }
                    }
                }
            }
        } }
    }
}

fn observer_peaks(replication: &Replication) -> Markup {
    let Some(peaks) = &replication.runs[0].report.metrics.z_peak_deg else { return html! {} };
    let diverged = replication.diverged(Scheme::Proposed.id());
    html! {
        div.scroll { table {
            caption { "Peak observer error of the proposed scheme [°] (K_d is calibrated to the paper's values: no evidence)" }
            thead { tr { th scope="col" { "Joint" } th scope="col" { "ours" } th scope="col" { "paper" } th scope="col" { "ratio" } } }
            tbody {
                @for (joint, (ours, paper)) in peaks.iter().zip(OBSERVER_PEAKS_DEG).enumerate() {
                    tr {
                        th scope="row" { (joint + 1) }
                        td { (cells::ours(diverged, *ours)) } td { (paper) } td.ratio { (cells::ratio(diverged, ours / paper, 3)) }
                    }
                }
            }
        } }
    }
}

fn claims(replication: &Replication) -> Markup {
    html! {
        ol.claims {
            @for claim in &replication.claims {
                li {
                    @match claim.verdict {
                        Verdict::Holds => span.verdict.good { "✓ holds" },
                        Verdict::DoesNotHold => span.verdict.bad { "✗ does not hold" },
                        Verdict::NotTested => span.verdict { "– not tested" },
                    }
                    " " (claim.claim)
                    dl {
                        dt { "Criterion" } dd { (claim.criterion) }
                        dt { "Found" } dd { (claim.evidence) }
                    }
                }
            }
        }
    }
}

fn figure_block(figure: Figure, svg: &str) -> Markup {
    html! {
        figure {
            (PreEscaped(svg))
            figcaption {
                (figure.title())
                @if let Some(number) = figure.paper_number() { " (figure " (number) " of the paper)" }
            }
        }
    }
}

fn assumptions(replication: &Replication) -> Markup {
    html! {
        div.scroll { table.text {
            thead { tr { th scope="col" { "About" } th scope="col" { "The paper" } th scope="col" { "Here" } th scope="col" { "Scenario field" } } }
            tbody {
                @for assumption in &replication.assumptions {
                    tr {
                        th scope="row" { (assumption.about) }
                        td { (assumption.paper) } td { (assumption.here) }
                        td { @if let Some(field) = assumption.field { code { (field) } } }
                    }
                }
            }
        } }
    }
}

fn runs(replication: &Replication) -> Markup {
    html! {
        div.scroll { table.text {
            thead { tr { th scope="col" { "Scheme" } th scope="col" { "Scenario hash" } th scope="col" { "Trajectory hash" } } }
            tbody {
                @for report in &replication.reports {
                    tr {
                        th scope="row" { (report.scheme) }
                        td { code { (report.scenario_hash) } } td { code { (report.trajectory_hash) } }
                    }
                }
            }
        } }
    }
}
