//! Small file operations that keep what they promise.
