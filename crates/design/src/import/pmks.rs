//! Share links of PMKS+ and of the older PMKS. The query of the web address contains the whole mechanism.

mod build;
mod classic;
mod records;
mod token;

use super::parts::Parts;
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};

/// The mechanism of a share link. `address` is the whole web address, or only its query.
pub(super) fn parts(address: &str) -> Result<Parts> {
    if address.lines().count() > 1 {
        return unknown(sentences::THE_SOURCE_HAS_SEVERAL_LINES);
    }
    let query = address.split_once('?').map_or(address, |(_, query)| query);
    let query = token::unescaped(query);
    if query.is_empty() {
        return unknown(sentences::THE_ADDRESS_HAS_NO_QUERY);
    }
    if query.starts_with("pmks2:") {
        return unknown(sentences::THE_LINK_HAS_ANOTHER_VERSION);
    }
    if query.split('&').any(|part| part.starts_with("mech=")) {
        return classic::parts(&query);
    }
    build::parts(records::records(&query)?)
}

fn unknown<T>(message: &str) -> Result<T> {
    Err(Error::new(ErrorKind::Unsupported, message).help(sentences::GIVE_A_LINK_OR_A_FILE))
}
