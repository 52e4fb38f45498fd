//! Properties of views (camera, grid, legend, axes) in a layout. rerun's builders cannot set them yet (rerun-io/rerun#12767), so they are
//! added to the messages that a builder makes.

use rerun::blueprint::{Blueprint, BlueprintActivation, View};
use rerun::external::re_log_types::LogMsg;
use rerun::{AsComponents, EntityPath, RecordingStream, RecordingStreamBuilder};

use super::recorder::Fault;

/// What a layout's builders cannot say: archetypes at paths of the blueprint.
#[derive(Default)]
pub(super) struct Properties(Vec<(EntityPath, Box<dyn AsComponents>)>);

impl Properties {
    /// Gives `view` a property: an archetype, under the archetype's short name.
    pub(super) fn set(&mut self, view: &View, name: &str, archetype: impl AsComponents + 'static) {
        self.0.push((view.blueprint_path().join(&EntityPath::from(name)), Box::new(archetype)));
    }

    /// Gives `entity` a property in `view` alone.
    pub(super) fn set_for_entity(&mut self, view: &View, entity: &EntityPath, archetype: impl AsComponents + 'static) {
        let overrides = view.blueprint_path().join(&EntityPath::from("ViewContents/overrides")).join(entity);
        self.0.push((overrides.join(&EntityPath::from("visualizers")), Box::new(archetype)));
    }
}

/// Sends `blueprint` with the properties of its views, to be shown at once.
pub(super) fn send(
    stream: &RecordingStream,
    application: &'static str,
    blueprint: &Blueprint,
    properties: &Properties,
) -> Result<(), Fault> {
    let (built, storage) = RecordingStreamBuilder::new(application).send_properties(false).memory()?;
    blueprint.send(&built, BlueprintActivation::default())?;
    built.flush_blocking()?;
    let (mut messages, mut activation) = (Vec::new(), None);
    for message in storage.take() {
        match message {
            LogMsg::BlueprintActivationCommand(command) => activation = Some(command),
            message if message.store_id().is_blueprint() => messages.push(message),
            _ => {}
        }
    }
    let activation = activation.ok_or("rerun made a layout without activating it")?;
    let (added, storage) = RecordingStreamBuilder::from_store_id(&activation.blueprint_id).blueprint().memory()?;
    added.set_time_sequence("blueprint", 0);
    for (path, archetype) in &properties.0 {
        added.log(path.clone(), &**archetype)?;
    }
    added.flush_blocking()?;
    messages.extend(storage.take().into_iter().filter(|message| !matches!(message, LogMsg::SetStoreInfo(_))));
    stream.send_blueprint(messages, activation);
    Ok(())
}
