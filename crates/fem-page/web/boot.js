// What goes wrong is told, also in a browser too old for the rest: plain words of long ago.
(function () {
  'use strict';
  var box = document.getElementById('fault');
  function tell(title, help) {
    if (!box) return;
    box.textContent = '';
    [['strong', title], ['p', help]].forEach(function (pair) {
      var made = document.createElement(pair[0]);
      made.textContent = pair[1];
      box.appendChild(made);
    });
    box.hidden = false;
    document.getElementById('status').textContent = '';
    document.querySelector('main').classList.add('stale');
  }
  function failed(what) {
    tell('Something in this page failed; what it shows may be of the case before.', what + ' – load the page again. If it fails again, whoever made it would like to know.');
  }
  window.addEventListener('error', function (event) { failed(String(event.message || event.error)); });
  window.addEventListener('unhandledrejection', function (event) { failed(String((event.reason && event.reason.message) || event.reason)); });
  var missing = [
    ['Worker', 'workers'], ['WebAssembly', 'WebAssembly'], ['DecompressionStream', 'DecompressionStream'], ['Blob', 'blobs'],
  ].filter(function (pair) { return !window[pair[0]]; }).map(function (pair) { return pair[1]; });
  if (!('noModule' in document.createElement('script'))) missing.push('modules');
  if (missing.length === 0) return;
  document.documentElement.dataset.missing = missing.join(', ');
  tell('This browser cannot compute here.', 'It lacks ' + missing.join(', ') + ', or they are switched off. Chrome, Edge, Firefox and Safari have them since 2023.');
})();
