//! Which addresses may be called: public ones, and those that the operator allows.
//!
//! What counts is the address that is connected to. Names are judged inside the client's resolver, after resolving, so
//! that no second look-up can answer differently (DNS rebinding); literal addresses never reach a resolver and are
//! judged before sending.

use super::addresses::{Network, reserved};
use reqwest::dns::{Addrs, Name, Resolve, Resolving};
use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;
use thiserror::Error;
use url::{Host, Url};

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
    "{host} has no public address ({kind}); only public addresses and those that the server's settings allow are called"
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
            let first = unwrapped(address.parse().map_err(|_| "does not begin with an address")?)?;
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
            let first = unwrapped(first)?;
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

/// Refuses IPv6 forms of IPv4 addresses: those are judged as what they wrap, so that such an entry would never count.
fn unwrapped(address: IpAddr) -> Result<IpAddr, &'static str> {
    if address.to_canonical() == address {
        Ok(address)
    } else {
        Err("wraps an IPv4 address, which is to be given itself")
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
        assert_eq!(Policy::all().refuses(ip("169.254.169.254")), None);
        assert_eq!(Policy::public().refuses(ip("169.254.169.254")), Some("link-local"));
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
            ("::ffff:10.0.0.0/104", "wraps an IPv4 address"),
            ("::ffff:10.0.0.1", "wraps an IPv4 address"),
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
