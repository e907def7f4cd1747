//! The numbers after a PLY file's header, one after another.

use std::io::{self, BufRead};

use super::super::error::Fault;
use super::header::{Encoding, Kind};

/// Longest number in text.
const LONGEST_TOKEN: usize = 64;

/// Reads numbers as the header says they are written.
pub(super) struct Numbers<R> {
    reader: R,
    encoding: Encoding,
    /// Bytes of a binary file after the header, or lines of a text, for messages.
    position: u64,
    token: Vec<u8>,
}

impl<R: BufRead> Numbers<R> {
    pub fn new(reader: R, encoding: Encoding, header_lines: usize) -> Self {
        let position = if encoding == Encoding::Ascii {
            header_lines as u64 + 1
        } else {
            0
        };
        Self {
            reader,
            encoding,
            position,
            token: Vec::new(),
        }
    }

    /// The next number, whatever its type; integers of 32 bits are exact.
    pub fn next(&mut self, kind: Kind) -> Result<f64, Fault> {
        match self.encoding {
            Encoding::Ascii => self.text(),
            Encoding::LittleEndian => self.binary(kind, false),
            Encoding::BigEndian => self.binary(kind, true),
        }
    }

    /// The length of a list.
    pub fn length(&mut self, kind: Kind) -> Result<u64, Fault> {
        let length = self.next(kind)?;
        if (0.0..=f64::from(u32::MAX)).contains(&length) && length.fract() == 0.0 {
            return Ok(length as u64);
        }
        let message = format!("found a list of {length} numbers; export the file again");
        Err(Fault::new(self.place(), message))
    }

    fn place(&self) -> String {
        let at = self.position;
        match self.encoding {
            Encoding::Ascii => format!("line {at}"),
            _ => format!("byte {at} after the header"),
        }
    }

    fn binary(&mut self, kind: Kind, big_endian: bool) -> Result<f64, Fault> {
        let mut bytes = [0_u8; 8];
        let size = kind.bytes();
        if let Err(error) = self.reader.read_exact(&mut bytes[..size]) {
            return Err(Fault::unreadable(self.place(), &error));
        }
        self.position += size as u64;
        if big_endian {
            bytes[..size].reverse();
        }
        let two = [bytes[0], bytes[1]];
        let four = [bytes[0], bytes[1], bytes[2], bytes[3]];
        Ok(match kind {
            Kind::I8 => f64::from(bytes[0] as i8),
            Kind::U8 => f64::from(bytes[0]),
            Kind::I16 => f64::from(i16::from_le_bytes(two)),
            Kind::U16 => f64::from(u16::from_le_bytes(two)),
            Kind::I32 => f64::from(i32::from_le_bytes(four)),
            Kind::U32 => f64::from(u32::from_le_bytes(four)),
            Kind::F32 => f64::from(f32::from_le_bytes(four)),
            Kind::F64 => f64::from_le_bytes(bytes),
        })
    }

    fn text(&mut self) -> Result<f64, Fault> {
        if let Err(error) = self.read_token() {
            return Err(Fault::unreadable(self.place(), &error));
        }
        let number = std::str::from_utf8(&self.token)
            .ok()
            .and_then(|token| token.parse().ok());
        number.ok_or_else(|| {
            let found = String::from_utf8_lossy(&self.token);
            Fault::new(
                self.place(),
                format!("found \"{found}\"; a number is needed"),
            )
        })
    }

    /// The next run of characters that are not white.
    fn read_token(&mut self) -> io::Result<()> {
        self.token.clear();
        loop {
            let buffered = self.reader.fill_buf()?;
            if buffered.is_empty() {
                let empty = self.token.is_empty();
                return if empty {
                    Err(io::ErrorKind::UnexpectedEof.into())
                } else {
                    Ok(())
                };
            }
            let mut used = 0;
            let mut done = false;
            for &byte in buffered {
                if !byte.is_ascii_whitespace() {
                    self.token.push(byte);
                } else if !self.token.is_empty() {
                    // The white character stays, for the count of lines.
                    done = true;
                    break;
                } else if byte == b'\n' {
                    self.position += 1;
                }
                used += 1;
                if self.token.len() > LONGEST_TOKEN {
                    done = true;
                    break;
                }
            }
            self.reader.consume(used);
            if done {
                return Ok(());
            }
        }
    }
}
