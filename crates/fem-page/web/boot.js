// Reports errors, also in browsers that are too old for the rest: this file uses old JavaScript only.
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
    tell('An error occurred in this page; it may still show the previous case.', what + ' – load the page again. If the error returns, please report it.');
  }
  window.addEventListener('error', function (event) { failed(String(event.message || event.error)); });
  window.addEventListener('unhandledrejection', function (event) { failed(String((event.reason && event.reason.message) || event.reason)); });
  var missing = [
    ['Worker', 'workers'], ['WebAssembly', 'WebAssembly'], ['DecompressionStream', 'DecompressionStream'], ['Blob', 'blobs'],
  ].filter(function (pair) { return !window[pair[0]]; }).map(function (pair) { return pair[1]; });
  if (!('noModule' in document.createElement('script'))) missing.push('modules');
  if (missing.length === 0) return;
  document.documentElement.dataset.missing = missing.join(', ');
  tell('This browser cannot compute here.', 'It lacks ' + missing.join(', ') + ', or they are switched off. Chrome, Edge, Firefox and Safari support them since 2023.');
})();
