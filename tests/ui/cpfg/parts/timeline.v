angle increment: 45
function set: timeline.tset
