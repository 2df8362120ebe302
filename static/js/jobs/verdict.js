// Do server and browser agree on a scheme? A comparison of hashes, and where they cannot be compared, the reason.

/**
 * What is known of one scheme, as the name of a verdict:
 * - "hidden": not submitted, for it was hidden;
 * - "pending", "none": the server has no report yet; it ended without one;
 * - "misread": the server gives the submitted document another hash, so it means another scenario there;
 * - "changed": the page's settings are others now;
 * - "computing", "stopped", "unable": the browser has no result yet; its run was stopped; it failed;
 * - "same", "same-diverged": equal bits;
 * - "version": other bits from another version of the core;
 * - "different": other bits from the same version.
 *
 * `submitted` is the submitted scenario's hash or null, `report` the server's, `ended` whether more can come, `shown` the hash
 * of the page's document, `local` the laboratory's result of it or null.
 */
export function verdict({ submitted, report, ended, shown, local }) {
  if (submitted === null) {
    return "hidden";
  }
  if (!report) {
    return ended ? "none" : "pending";
  }
  if (report.scenario_hash !== submitted) {
    return "misread";
  }
  if (shown !== submitted) {
    return "changed";
  }
  if (local?.failure) {
    return "unable";
  }
  if (local?.stoppedAt !== undefined) {
    return "stopped";
  }
  if (local?.report?.scenario_hash !== submitted) {
    return "computing";
  }
  if (local.report.trajectory_hash === report.trajectory_hash) {
    return report.outcome === "diverged" ? "same-diverged" : "same";
  }
  return local.report.core_version === report.core_version ? "different" : "version";
}
