//! What the system knows about this process, read from `/proc`; elsewhere than on Linux there is nothing.

use ::metrics::gauge;
use std::fs::read_to_string;

/// Units of time in `/proc`, per second; the same on every Linux this runs on.
const TICKS_PER_SECOND: f64 = 100.0;

/// Brings the gauges up to date.
pub(super) fn record() {
    if let Some(bytes) = read_to_string("/proc/self/status").ok().and_then(|text| resident_bytes(&text)) {
        gauge!("process_resident_memory_bytes").set(bytes);
    }
    let texts = read_to_string("/proc/self/stat").ok().zip(read_to_string("/proc/stat").ok());
    if let Some(seconds) = texts.and_then(|(process, system)| start_time(&process, &system)) {
        gauge!("process_start_time_seconds").set(seconds);
    }
}

fn resident_bytes(status: &str) -> Option<f64> {
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kilobytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kilobytes * 1024.0)
}

/// Since 1970, from `/proc/self/stat` and `/proc/stat`.
fn start_time(process: &str, system: &str) -> Option<f64> {
    // The second field, the program's name in brackets, may hold anything; the start is the 22nd.
    let (_, fields) = process.rsplit_once(')')?;
    let ticks: f64 = fields.split_whitespace().nth(19)?.parse().ok()?;
    let boot: f64 = system.lines().find_map(|line| line.strip_prefix("btime "))?.trim().parse().ok()?;
    Some(boot + ticks / TICKS_PER_SECOND)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn proc_is_read_as_documented() {
        assert_eq!(resident_bytes("Name:\tx\nVmRSS:\t    2048 kB\nThreads:\t1\n"), Some(2_097_152.0));
        assert_eq!(resident_bytes("Name:\tx\n"), None);
        let process = "42 (a ) b) S 1 42 42 0 -1 4194560 1 0 0 0 0 0 0 0 20 0 1 0 12345 1000 10";
        assert_eq!(start_time(process, "cpu 1 2\nbtime 1000\n"), Some(1123.45));
        assert_eq!(start_time("42 (x) S 1", "btime 1000\n"), None);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn this_process_began_before_now_and_takes_memory() {
        let bytes = resident_bytes(&read_to_string("/proc/self/status").unwrap()).unwrap();
        assert!(bytes > 1e6, "{bytes}");
        let began = read_to_string("/proc/self/stat").ok().zip(read_to_string("/proc/stat").ok());
        let began = began.and_then(|(process, system)| start_time(&process, &system)).unwrap();
        let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap().as_secs_f64();
        // The system counts ticks from its own idea of the boot, to about a second.
        assert!(began < now + 2.0 && now - began < 3600.0, "{began} {now}");
    }
}
