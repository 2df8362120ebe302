//! Which cryptography TLS uses in this process.

/// Makes ring the process's provider, unless one has been chosen already. Needed before any client that may speak TLS.
pub fn install_crypto_provider() {
    // The error says that there is one already, which is all that is wanted.
    let _ = rustls::crypto::ring::default_provider().install_default();
}
