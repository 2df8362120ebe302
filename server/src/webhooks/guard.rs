//! Which addresses may be called: public ones, and those that the operator allows.
//!
//! What counts is the address that is connected to. Names are judged inside the client's resolver, after resolving, so
//! that no second look-up can answer differently (DNS rebinding); literal addresses never reach a resolver and are
//! judged before sending.

use reqwest::dns::{Addrs, Name, Resolve, Resolving};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::sync::Arc;
use thiserror::Error;
use url::{Host, Url};

/// IPv4 networks that are not the public internet. Source: IANA's registry of special-purpose addresses.
const RESERVED_V4: [([u8; 4], u8, &str); 17] = [
    ([0, 0, 0, 0], 8, "unspecified"),
    ([10, 0, 0, 0], 8, "private"),
    ([100, 64, 0, 0], 10, "carrier-grade NAT"),
    ([127, 0, 0, 0], 8, "loopback"),
    // Clouds answer questions about their machines at 169.254.169.254.
    ([169, 254, 0, 0], 16, "link-local"),
    // The same of Azure; it looks public, but is reachable only from inside.
    ([168, 63, 129, 16], 32, "cloud platform"),
    ([172, 16, 0, 0], 12, "private"),
    ([192, 0, 0, 0], 24, "reserved"),
    ([192, 0, 2, 0], 24, "documentation"),
    ([192, 88, 99, 0], 24, "reserved"),
    ([192, 168, 0, 0], 16, "private"),
    ([198, 18, 0, 0], 15, "benchmarking"),
    ([198, 51, 100, 0], 24, "documentation"),
    ([203, 0, 113, 0], 24, "documentation"),
    ([224, 0, 0, 0], 4, "multicast"),
    ([255, 255, 255, 255], 32, "broadcast"),
    ([240, 0, 0, 0], 4, "reserved"),
];

/// IPv6 networks that are not the public internet, the narrower ones first. Source: as above.
const RESERVED_V6: [([u16; 8], u8, &str); 11] = [
    ([0, 0, 0, 0, 0, 0, 0, 0], 128, "unspecified"),
    ([0, 0, 0, 0, 0, 0, 0, 1], 128, "loopback"),
    ([0xfc00, 0, 0, 0, 0, 0, 0, 0], 7, "private"),
    ([0xfe80, 0, 0, 0, 0, 0, 0, 0], 10, "link-local"),
    ([0xfec0, 0, 0, 0, 0, 0, 0, 0], 10, "private"),
    ([0xff00, 0, 0, 0, 0, 0, 0, 0], 8, "multicast"),
    ([0x2001, 2, 0, 0, 0, 0, 0, 0], 48, "benchmarking"),
    ([0x2001, 0xdb8, 0, 0, 0, 0, 0, 0], 32, "documentation"),
    ([0x3fff, 0, 0, 0, 0, 0, 0, 0], 20, "documentation"),
    // Protocol assignments; Teredo, which wraps IPv4 addresses, is among them.
    ([0x2001, 0, 0, 0, 0, 0, 0, 0], 23, "reserved"),
    ([0x5f00, 0, 0, 0, 0, 0, 0, 0], 16, "reserved"),
];

/// Everything that the internet's routers pass on is in here.
const GLOBAL_UNICAST: Network = Network::v6([0x2000, 0, 0, 0, 0, 0, 0, 0], 3);
/// IPv4 addresses in the last 32 bits.
const NAT64: Network = Network::v6([0x64, 0xff9b, 0, 0, 0, 0, 0, 0], 96);
/// IPv4 addresses in bits 16 to 47.
const SIX_TO_FOUR: Network = Network::v6([0x2002, 0, 0, 0, 0, 0, 0, 0], 16);

/// A range of addresses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Network {
    first: IpAddr,
    prefix: u8,
}

impl Network {
    const fn v4([a, b, c, d]: [u8; 4], prefix: u8) -> Self {
        Self { first: IpAddr::V4(Ipv4Addr::new(a, b, c, d)), prefix }
    }

    const fn v6([a, b, c, d, e, f, g, h]: [u16; 8], prefix: u8) -> Self {
        Self { first: IpAddr::V6(Ipv6Addr::new(a, b, c, d, e, f, g, h)), prefix }
    }

    /// Whether `first` has no bits behind the prefix.
    fn begins_at_first(self) -> bool {
        match self.first {
            IpAddr::V4(first) => first.to_bits().trailing_zeros() + u32::from(self.prefix) >= 32,
            IpAddr::V6(first) => first.to_bits().trailing_zeros() + u32::from(self.prefix) >= 128,
        }
    }

    fn contains(self, address: IpAddr) -> bool {
        // A prefix of 0 shifts everything out, which Rust does not let a plain shift do.
        match (self.first, address) {
            (IpAddr::V4(first), IpAddr::V4(address)) => {
                let differing = first.to_bits() ^ address.to_bits();
                differing.checked_shr(32 - u32::from(self.prefix)).unwrap_or(0) == 0
            }
            (IpAddr::V6(first), IpAddr::V6(address)) => {
                let differing = first.to_bits() ^ address.to_bits();
                differing.checked_shr(128 - u32::from(self.prefix)).unwrap_or(0) == 0
            }
            _ => false,
        }
    }
}

/// What keeps an address from being public, if anything.
fn reserved(address: IpAddr) -> Option<&'static str> {
    match address.to_canonical() {
        IpAddr::V4(address) => RESERVED_V4
            .into_iter()
            .find_map(|(first, prefix, kind)| Network::v4(first, prefix).contains(address.into()).then_some(kind)),
        IpAddr::V6(address) => {
            let ip = IpAddr::V6(address);
            let bits = address.to_bits();
            if NAT64.contains(ip) {
                return reserved(Ipv4Addr::from_bits(bits as u32).into());
            }
            if SIX_TO_FOUR.contains(ip) {
                return reserved(Ipv4Addr::from_bits((bits >> 80) as u32).into());
            }
            RESERVED_V6
                .into_iter()
                .find_map(|(first, prefix, kind)| Network::v6(first, prefix).contains(ip).then_some(kind))
                .or_else(|| (!GLOBAL_UNICAST.contains(ip)).then_some("reserved"))
        }
    }
}

/// Whom webhooks may reach.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Policy {
    all: bool,
    networks: Vec<Network>,
    hosts: Vec<String>,
}

/// An entry of the allow list that means nothing.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{entry:?} {why}; allowed: an address, a network such as 10.0.0.0/8, or a host name without port")]
pub struct PolicyError {
    /// The entry.
    pub entry: String,
    /// What is wrong with it.
    pub why: &'static str,
}

/// A host that may not be called. Does not name the address: what internal names lead to is nobody's business.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "{host} has no public address ({kind}); webhooks go to public addresses and to those that the server's settings allow"
)]
pub struct Refused {
    /// The host, as the webhook's address names it.
    pub host: String,
    /// What its address is.
    pub kind: &'static str,
}

impl Policy {
    /// Public addresses only.
    pub fn public() -> Self {
        Self::default()
    }

    /// Every address. For machines whose users may reach everything anyway.
    pub fn all() -> Self {
        Self { all: true, ..Self::default() }
    }

    /// Public addresses, and those in `entries`: addresses, networks (`10.0.0.0/8`) or host names.
    pub fn allowing<S: AsRef<str>>(entries: impl IntoIterator<Item = S>) -> Result<Self, PolicyError> {
        let mut policy = Self::default();
        for entry in entries {
            let entry = entry.as_ref();
            policy.allow(entry).map_err(|why| PolicyError { entry: entry.to_owned(), why })?;
        }
        Ok(policy)
    }

    fn allow(&mut self, entry: &str) -> Result<(), &'static str> {
        if let Some((address, prefix)) = entry.split_once('/') {
            let first: IpAddr = address.parse().map_err(|_| "does not begin with an address")?;
            let longest = if first.is_ipv4() { 32 } else { 128 };
            let digits = prefix.bytes().all(|byte| byte.is_ascii_digit());
            let prefix = prefix.parse().ok().filter(|prefix| digits && *prefix <= longest);
            let prefix = prefix.ok_or("has a prefix that is not 0 to 32 (IPv4) or 0 to 128 (IPv6)")?;
            let network = Network { first, prefix };
            if !network.begins_at_first() {
                return Err("has bits set behind its prefix");
            }
            self.networks.push(network);
            return Ok(());
        }
        if let Ok(first) = entry.parse::<IpAddr>() {
            self.networks.push(Network { first, prefix: if first.is_ipv4() { 32 } else { 128 } });
            return Ok(());
        }
        match Host::parse(entry) {
            Ok(Host::Domain(name)) if !name.contains('*') => self.hosts.push(plain(&name)),
            _ => return Err("is not a host name"),
        }
        Ok(())
    }

    /// What keeps `address` from being called, if anything.
    fn refuses(&self, address: IpAddr) -> Option<&'static str> {
        let address = address.to_canonical();
        if self.all || self.networks.iter().any(|network| network.contains(address)) { None } else { reserved(address) }
    }

    /// Judges a host that is an address itself; names pass, since they are judged when they are resolved.
    pub fn check_literal(&self, url: &Url) -> Result<(), Refused> {
        let address = match url.host() {
            Some(Host::Ipv4(address)) => IpAddr::V4(address),
            Some(Host::Ipv6(address)) => IpAddr::V6(address),
            Some(Host::Domain(_)) | None => return Ok(()),
        };
        match self.refuses(address) {
            Some(kind) => Err(Refused { host: address.to_string(), kind }),
            None => Ok(()),
        }
    }

    /// Those of a name's addresses that may be called; an error when none is left.
    fn choose(&self, host: &str, found: Vec<SocketAddr>) -> Result<Vec<SocketAddr>, Refused> {
        if self.hosts.contains(&plain(host)) {
            return Ok(found);
        }
        let refused = found.iter().find_map(|address| self.refuses(address.ip()));
        let allowed: Vec<_> = found.into_iter().filter(|address| self.refuses(address.ip()).is_none()).collect();
        match refused {
            Some(kind) if allowed.is_empty() => Err(Refused { host: host.to_owned(), kind }),
            _ => Ok(allowed),
        }
    }
}

/// A host name in the one form in which names are compared.
fn plain(host: &str) -> String {
    host.trim_end_matches('.').to_ascii_lowercase()
}

/// The system's resolver, which forgets the addresses that may not be called.
#[derive(Debug, Clone)]
pub struct GuardedResolver(pub Arc<Policy>);

impl Resolve for GuardedResolver {
    fn resolve(&self, name: Name) -> Resolving {
        let policy = Arc::clone(&self.0);
        Box::pin(async move {
            let found = tokio::net::lookup_host((name.as_str(), 0)).await?.collect();
            Ok(Box::new(policy.choose(name.as_str(), found)?.into_iter()) as Addrs)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ip(text: &str) -> IpAddr {
        text.parse().unwrap()
    }

    #[test]
    fn public_addresses_are_called() {
        for address in [
            "1.1.1.1",
            "9.255.255.255",
            "11.0.0.0",
            "100.63.255.255",
            "100.128.0.0",
            "172.15.255.255",
            "172.32.0.0",
            "192.167.255.255",
            "198.17.255.255",
            "198.20.0.0",
            "223.255.255.255",
            "::ffff:1.1.1.1",
            "64:ff9b::1.1.1.1",
            "2002:101:101::1",
            "2606:4700::1111",
            "2a00::1",
        ] {
            assert_eq!(Policy::public().refuses(ip(address)), None, "{address}");
        }
    }

    #[test]
    fn addresses_of_inner_networks_are_refused_in_every_form() {
        for (address, kind) in [
            ("0.0.0.0", "unspecified"),
            ("0.1.2.3", "unspecified"),
            ("10.0.0.1", "private"),
            ("100.64.0.1", "carrier-grade NAT"),
            ("100.127.255.255", "carrier-grade NAT"),
            ("127.0.0.1", "loopback"),
            ("127.255.255.254", "loopback"),
            ("168.63.129.16", "cloud platform"),
            ("169.254.169.254", "link-local"),
            ("172.16.0.1", "private"),
            ("172.31.255.255", "private"),
            ("192.0.0.192", "reserved"),
            ("192.0.2.1", "documentation"),
            ("192.168.255.255", "private"),
            ("198.18.0.1", "benchmarking"),
            ("198.19.255.255", "benchmarking"),
            ("198.51.100.7", "documentation"),
            ("203.0.113.7", "documentation"),
            ("224.0.0.1", "multicast"),
            ("239.255.255.250", "multicast"),
            ("240.0.0.1", "reserved"),
            ("255.255.255.255", "broadcast"),
            ("::", "unspecified"),
            ("::1", "loopback"),
            ("::127.0.0.1", "reserved"),
            ("::ffff:127.0.0.1", "loopback"),
            ("::ffff:10.0.0.1", "private"),
            ("::ffff:0:127.0.0.1", "reserved"),
            ("64:ff9b::169.254.169.254", "link-local"),
            ("64:ff9b:1::a00:1", "reserved"),
            ("100::1", "reserved"),
            ("2001::1", "reserved"),
            ("2001:2::1", "benchmarking"),
            ("2001:db8::1", "documentation"),
            ("2002:a00:1::1", "private"),
            ("2002:7f00:1::", "loopback"),
            ("3fff::1", "documentation"),
            ("5f00::1", "reserved"),
            ("fc00::1", "private"),
            ("fd00:ec2::254", "private"),
            ("fe80::1", "link-local"),
            ("fec0::1", "private"),
            ("ff02::1", "multicast"),
        ] {
            assert_eq!(Policy::public().refuses(ip(address)), Some(kind), "{address}");
            assert_eq!(Policy::all().refuses(ip(address)), None, "{address}");
        }
    }

    #[test]
    fn the_operator_s_list_opens_what_it_names_and_no_more() {
        let policy = Policy::allowing(["10.1.0.0/16", "127.0.0.1", "fd00::/8", "Hooks.Internal."]).unwrap();
        for address in ["10.1.2.3", "127.0.0.1", "::ffff:127.0.0.1", "fd12::1"] {
            assert_eq!(policy.refuses(ip(address)), None, "{address}");
        }
        for address in ["10.2.0.1", "127.0.0.2", "fc00::1", "64:ff9b::10.1.2.3"] {
            assert!(policy.refuses(ip(address)).is_some(), "{address}");
        }
        let inner = vec![SocketAddr::from(([192, 168, 0, 1], 0))];
        assert_eq!(policy.choose("hooks.internal", inner.clone()), Ok(inner.clone()));
        assert_eq!(policy.choose("HOOKS.INTERNAL.", inner.clone()), Ok(inner.clone()));
        let refused = Refused { host: "other.internal".to_owned(), kind: "private" };
        assert_eq!(policy.choose("other.internal", inner), Err(refused));
        let everything = Policy::allowing(["0.0.0.0/0", "::/0"]).unwrap();
        assert_eq!(everything.refuses(ip("127.0.0.1")), None);
        assert_eq!(everything.refuses(ip("::1")), None);
    }

    #[test]
    fn of_a_name_with_several_addresses_only_the_public_ones_are_used() {
        let found: Vec<SocketAddr> = ["127.0.0.1:0", "1.1.1.1:0", "[::1]:0"].map(|text| text.parse().unwrap()).into();
        assert_eq!(Policy::public().choose("two-faced.example", found.clone()), Ok(vec![found[1]]));
    }

    #[test]
    fn meaningless_entries_are_refused() {
        for (entry, why) in [
            ("10.0.0.1/8", "has bits set behind its prefix"),
            ("fd00::1/8", "has bits set behind its prefix"),
            ("10.0.0.0/33", "has a prefix that is not"),
            ("10.0.0.0/+8", "has a prefix that is not"),
            ("10.0.0.0/", "has a prefix that is not"),
            ("::/129", "has a prefix that is not"),
            ("intern/8", "does not begin with an address"),
            ("", "is not a host name"),
            ("*.example.org", "is not a host name"),
            ("https://example.org", "does not begin with an address"),
            ("example.org:443", "is not a host name"),
            ("0x7f.1", "is not a host name"),
        ] {
            let said = Policy::allowing([entry]).unwrap_err().to_string();
            assert!(said.starts_with(&format!("{entry:?} {why}")), "{said}");
        }
    }
}
