//! Values as bytes that notice when they are damaged: MessagePack, compressed, with a hash in front.

use serde::Serialize;
use serde::de::DeserializeOwned;
use thiserror::Error;

/// Fast, and numbers hardly get smaller by trying harder.
const COMPRESSION_LEVEL: i32 = 1;

/// Bytes that are not what was packed, or a value that cannot be.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct PackError(String);

impl PackError {
    fn of(error: impl std::fmt::Display) -> Self {
        Self(error.to_string())
    }
}

/// As bytes. Takes milliseconds for large values: not for an async task.
pub fn pack(value: &impl Serialize) -> Result<Vec<u8>, PackError> {
    let plain = rmp_serde::to_vec_named(value).map_err(PackError::of)?;
    let packed = zstd::encode_all(&*plain, COMPRESSION_LEVEL).map_err(PackError::of)?;
    Ok([blake3::hash(&packed).as_bytes(), packed.as_slice()].concat())
}

/// From what [`pack`] gave.
pub fn unpack<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, PackError> {
    let (hash, packed) = bytes.split_at_checked(blake3::OUT_LEN).ok_or_else(|| PackError::of("it is too short"))?;
    if blake3::hash(packed).as_bytes() != hash {
        return Err(PackError::of("its hash differs"));
    }
    let plain = zstd::decode_all(packed).map_err(PackError::of)?;
    rmp_serde::from_slice(&plain).map_err(PackError::of)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_to_the_bit_and_damage_is_noticed() {
        let numbers = vec![Some(0.1 + 0.2), None, Some(5e-324), Some(-0.0)];
        let bytes = pack(&numbers).unwrap();
        let back: Vec<Option<f64>> = unpack(&bytes).unwrap();
        assert_eq!(
            back.iter().map(|x| x.map(f64::to_bits)).collect::<Vec<_>>(),
            numbers.iter().map(|x| x.map(f64::to_bits)).collect::<Vec<_>>()
        );
        for end in [0, 10, 40, bytes.len() - 1] {
            assert!(unpack::<Vec<Option<f64>>>(&bytes[..end]).is_err(), "{end} bytes");
        }
        let mut flipped = bytes;
        *flipped.last_mut().unwrap() ^= 1;
        assert!(unpack::<Vec<Option<f64>>>(&flipped).is_err());
    }
}
