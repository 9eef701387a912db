//! The service, asked without a socket.

mod access;
mod ask;
mod conditions;
mod evaluate;
mod hostile;
mod integrate;
mod jobs;
mod models;
mod openapi;
mod safety;
mod stored;
mod tables;
