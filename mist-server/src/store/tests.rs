//! The store on small disks, in folders, and with files that are none.

use std::sync::atomic::{AtomicU64, Ordering};

use redb::StorageBackend;

use super::*;

/// A disk with so many bytes, which stay there when the database is closed.
#[derive(Clone, Debug)]
struct Disk {
    bytes: Arc<RwLock<Vec<u8>>>,
    most: Arc<AtomicU64>,
}

impl StorageBackend for Disk {
    fn len(&self) -> io::Result<u64> {
        Ok(self.bytes.read().unwrap().len() as u64)
    }

    fn read(&self, offset: u64, out: &mut [u8]) -> io::Result<()> {
        let start = offset as usize;
        out.copy_from_slice(&self.bytes.read().unwrap()[start..start + out.len()]);
        Ok(())
    }

    fn set_len(&self, len: u64) -> io::Result<()> {
        if len > self.most.load(Ordering::Relaxed) {
            return Err(io::ErrorKind::StorageFull.into());
        }
        self.bytes.write().unwrap().resize(len as usize, 0);
        Ok(())
    }

    fn sync_data(&self) -> io::Result<()> {
        Ok(())
    }

    fn write(&self, offset: u64, data: &[u8]) -> io::Result<()> {
        let start = offset as usize;
        self.bytes.write().unwrap()[start..start + data.len()].copy_from_slice(data);
        Ok(())
    }
}

#[test]
fn a_full_disk_is_told_and_everything_before_it_is_still_there() {
    let disk = Disk { bytes: Arc::default(), most: Arc::new(AtomicU64::new(8 << 20)) };
    let backend = disk.clone();
    let store =
        Store::on(move || Database::builder().create_with_backend(backend.clone())).unwrap();
    store.put_material("small", "body", "owner").unwrap();
    let large = "x".repeat(16 << 20);
    assert!(store.put_material("large", &large, "owner").is_err());
    assert_eq!(
        store.materials().unwrap(),
        [("small".to_owned(), "body".to_owned(), Some("owner".to_owned()))]
    );
    disk.most.store(1 << 30, Ordering::Relaxed);
    store.put_material("large", &large, "owner").unwrap();
    assert_eq!(store.materials().unwrap().len(), 2);
}

#[test]
fn a_file_that_is_no_store_is_refused_with_its_name_and_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(FILE), "x".repeat(10_000)).unwrap();
    let error = Store::new(Some(folder.path())).unwrap_err().to_string();
    assert!(error.contains(FILE) && error.contains("move it away"), "{error}");
}

#[test]
fn a_folder_keeps_what_was_put_into_it() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::new(Some(folder.path())).unwrap();
    store.put_job("a", "{}", "program").unwrap();
    store.put_steps("a", 3, &[vec![1], vec![2]]).unwrap();
    let second = Store::new(Some(folder.path())).unwrap_err().to_string();
    assert!(second.contains("another service"), "{second}");
    drop(store);
    let store = Store::new(Some(folder.path())).unwrap();
    assert_eq!(store.step("a", 4).unwrap(), Some(vec![2]));
    assert_eq!(store.program("a").unwrap().as_deref(), Some("program"));
    store.finish_job("a", "{}", &[("results".into(), "text".into())]).unwrap();
    assert_eq!(store.step("a", 4).unwrap(), None);
    assert_eq!(store.text("a", "results").unwrap().as_deref(), Some("text"));
    store.remove_job("a").unwrap();
    assert_eq!(store.text("a", "results").unwrap(), None);
    assert!(store.jobs().unwrap().is_empty());
}

#[test]
fn a_truncated_or_overwritten_file_is_told_with_its_name_and_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(FILE);
    let store = Store::new(Some(folder.path())).unwrap();
    for number in 0..200 {
        store.put_material(&format!("m{number}"), &"x".repeat(5000), "owner").unwrap();
    }
    drop(store);
    let whole = std::fs::read(&file).unwrap();
    for kept in [100, 4096, whole.len() / 2, whole.len() - 4096] {
        std::fs::write(&file, &whole[..kept]).unwrap();
        let Err(error) = Store::new(Some(folder.path())) else { continue };
        let text = error.to_string();
        assert!(text.contains(FILE) && text.contains("restore it"), "{kept}: {text}");
    }
    for start in (0..whole.len()).step_by(whole.len() / 40) {
        let mut damaged = whole.clone();
        let end = (start + 600).min(damaged.len());
        damaged[start..end].fill(0xa5);
        std::fs::write(&file, &damaged).unwrap();
        // An error or the materials, and no panic.
        if let Ok(store) = Store::new(Some(folder.path())) {
            let _ = store.materials();
        }
    }
}

#[test]
fn a_text_that_was_changed_in_the_store_is_not_served() {
    let store = Store::new(None).unwrap();
    store.finish_job("a", "{}", &[("results".into(), "1 0.5\n".into())]).unwrap();
    assert_eq!(store.text("a", "results").unwrap().as_deref(), Some("1 0.5\n"));
    store
        .write(|change| {
            change.open_table(TEXTS)?.insert(("a", "results"), "1 0.6\n")?;
            Ok(())
        })
        .unwrap();
    let error = store.text("a", "results").unwrap_err().to_string();
    assert!(
        error.contains("results of the job a") && error.contains("run the job again"),
        "{error}"
    );
}
